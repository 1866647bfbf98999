#include <gracilis/geometry/wrapped_path.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gracilis {

static bool is_arc(const std::vector<PathStop>& points, std::size_t i) {
  return points[i].wrap >= 0 && points[i].wrap == points[i - 1].wrap;
}

Real length_of(const std::vector<PathStop>& points) {
  Real length = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    length += is_arc(points, i) ? points[i].around.length : (points[i].place - points[i - 1].place).norm();
  return length;
}

/// The part of the path, as indices of its points, in which a surface is tried; empty when none of the given points
/// that bound it is there.
static std::pair<std::size_t, std::size_t> range_of(const PlacedWrap& wrap, const std::vector<PathStop>& points) {
  std::size_t begin = points.size(), end = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].given < wrap.first_point || points[i].given > wrap.last_point) continue;
    begin = std::min(begin, i);
    end = std::max(end, i);
  }
  return begin < end ? std::pair{begin, end} : std::pair<std::size_t, std::size_t>{0, 0};
}

/// Takes a wrap's two points out of the path and puts them in anew where the path needs them.
static Wrap::Kind solve_path(const PlacedWrap& placed, int index, std::vector<PathStop>& points,
                             const PathSolver& solver) {
  std::erase_if(points, [&](const PathStop& point) { return point.wrap == index; });
  const RigidTransform into = placed.frame.inverse();
  const auto [begin, end] = range_of(placed, points);
  Wrap best;
  std::size_t place = 0;
  Real least = std::numeric_limits<Real>::infinity();
  Wrap::Kind last = Wrap::Kind::none;
  for (std::size_t i = begin; i < end; ++i) {
    if (is_arc(points, i + 1)) continue;
    const Vec3 a = into * points[i].place, b = into * points[i + 1].place;
    const Wrap wrap = solver.wrap(placed, a, b);
    last = wrap.kind;
    if (!wrap.touches()) continue;
    const Real change = (wrap.first() - a).norm() + wrap.length + (b - wrap.last()).norm() - (b - a).norm();
    if (wrap.kind == Wrap::Kind::needed || change < least) {
      best = wrap;
      place = i + 1;
      least = change;
    }
    if (wrap.kind == Wrap::Kind::needed) break;
  }
  if (place == 0) return last;
  PathStop first, second;
  first.body = second.body = placed.body;
  first.wrap = second.wrap = index;
  first.place = placed.frame * best.first();
  second.place = placed.frame * best.last();
  second.around = best;
  points.insert(points.begin() + static_cast<std::ptrdiff_t>(place), {first, second});
  return last;
}

void solve_path(const std::vector<PlacedWrap>& wraps, std::vector<PathStop>& points, const PathSolver& solver) {
  const std::size_t count = wraps.size();
  std::vector<std::size_t> order(count);
  for (std::size_t i = 0; i < count; ++i) order[i] = i;
  std::vector<Wrap::Kind> kinds(count);
  Real before = std::numeric_limits<Real>::infinity();
  for (int pass = 0; pass < (count < 2 ? 1 : 8) && count > 0; ++pass) {
    for (std::size_t i = 0; i < count; ++i)
      kinds[i] = solve_path(wraps[order[i]], static_cast<int>(order[i]), points, solver);
    const Real length = solver.length(points);
    if (std::abs(length - before) < 0.0005) break;
    before = length;
    // A point in the second surface, the first not met: try them the other way round.
    if (pass == 0 && count > 1 && kinds[0] == Wrap::Kind::none && kinds[1] == Wrap::Kind::inside)
      std::swap(order[0], order[1]);
  }
}

Points line_through(const std::vector<PathStop>& points, const std::vector<PlacedWrap>& wraps, Real largest_turn,
                    std::vector<Index>* bodies) {
  std::vector<Vec3> places;
  const auto add = [&](const Vec3& place, Index body) {
    if (!places.empty() && (place - places.back()).norm() < 1e-9) return;
    places.push_back(place);
    if (bodies) bodies->push_back(body);
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i > 0 && is_arc(points, i)) {
      const Arc& way = points[i].around.way;
      const RigidTransform& frame = wraps[static_cast<std::size_t>(points[i].wrap)].frame;
      const int parts = std::max(1, static_cast<int>(std::ceil(std::abs(way.sweep) / largest_turn)));
      for (int k = 1; k < parts; ++k) add(frame * way.at(static_cast<Real>(k) / parts), points[i].body);
    }
    add(points[i].place, points[i].body);
  }
  Points line(3, static_cast<Eigen::Index>(places.size()));
  for (std::size_t i = 0; i < places.size(); ++i) line.col(static_cast<Eigen::Index>(i)) = places[i];
  return line;
}

}  // namespace gracilis
