#include <gracilis/anatomy/fibers/traced_fibers.hpp>

#include <gracilis/anatomy/fibers/fiber_seams.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/mesh_pieces.hpp>
#include <gracilis/geometry/polylines.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

namespace gracilis {

FiberRoom::FiberRoom(const TriangleMesh& surface, const TriangleMesh& sheets, Index nodes_inside)
    : surface_(surface),
      distance_(surface),
      grid_(surface, distance_, sheets, nodes_inside),
      bounds_(merged({surface, sheets})),
      finds_seams_(sheets.face_count() == 0) {}

namespace {

/// The way along the field from a place inside to where it ends, beginning with the place; nothing where it ends
/// nowhere.
std::vector<Vec3> way_out(const FiberRoom& room, const FiberField& field, const Vec3& place, Real sign) {
  constexpr Real stride = 0.5;  // of the grid's step
  const Real step = stride * room.grid().step();
  const Vec3 size = room.surface().vertices.rowwise().maxCoeff() - room.surface().vertices.rowwise().minCoeff();
  const int most = static_cast<int>(2 * size.norm() / step);
  const Real reach = std::max(2 * room.grid().step(), field.smoothing());
  std::vector<Vec3> way = {place};
  for (int i = 0; i < most; ++i) {
    const Vec3 p = way.back();
    // The midpoint method; beyond a bound the field is another one.
    Vec3 ahead = sign * field.direction(p);
    if (!room.bounds().cut(p, p + step / 2 * ahead)) ahead = sign * field.direction(p + step / 2 * ahead);
    if (ahead.isZero()) return {};
    const std::optional<TriangleTree::Hit> hit = room.bounds().first(p, p + step * ahead);
    way.push_back(hit ? hit->place : p + step * ahead);
    if (hit) return way;
    if (!room.finds_seams()) continue;
    if (const std::optional<FiberSeam> seam = seam_at(field, way.back(), sign, reach)) {
      end_at_seam(*seam, reach, way);
      return way;
    }
  }
  return {};
}

}  // namespace

Points traced_fiber(const FiberRoom& room, const FiberField& field, const Vec3& place) {
  const std::vector<Vec3> back = way_out(room, field, place, -1), on = way_out(room, field, place, 1);
  if (back.empty() || on.empty()) return Points(3, 0);
  Points line(3, static_cast<Index>(back.size() + on.size() - 1));
  Index i = 0;
  for (auto at = back.rbegin(); at != back.rend(); ++at) line.col(i++) = *at;
  for (auto at = on.begin() + 1; at != on.end(); ++at) line.col(i++) = *at;
  return line;
}

namespace {

struct Candidate {
  Points line;
  Vec3 middle;
  Real length = 0, section = 0;  ///< m, and what of the room's section it stands for, in its own unit
};

/// One candidate for each of `count` parts of equal section: the nearest to the part's middle.
void take_evenly(std::span<const Candidate*> all, Index count, std::vector<Points>& taken) {
  Vec3 mean = Vec3::Zero(), low = all.front()->middle, high = low;
  Real sections = 0;
  for (const Candidate* each : all) {
    mean += each->section * each->middle;
    sections += each->section;
    low = low.cwiseMin(each->middle), high = high.cwiseMax(each->middle);
  }
  mean /= sections;
  const auto from_mean = [&](const Candidate* each) { return (each->middle - mean).squaredNorm(); };
  if (count == 1 || all.size() == 1) {
    const Candidate* nearest = *std::min_element(
        all.begin(), all.end(), [&](const Candidate* a, const Candidate* b) { return from_mean(a) < from_mean(b); });
    taken.insert(taken.end(), static_cast<std::size_t>(count), nearest->line);
    return;
  }
  Index axis = 0;
  (high - low).maxCoeff(&axis);
  std::stable_sort(all.begin(), all.end(),
                   [&](const Candidate* a, const Candidate* b) { return a->middle[axis] < b->middle[axis]; });
  const Index first = count / 2;
  std::size_t size = 0;
  for (Real passed = 0; size + 1 < all.size(); ++size) {
    passed += all[size]->section;
    if (size > 0 && passed > sections * first / count) break;
  }
  size = std::max<std::size_t>(size, 1);
  take_evenly(all.first(size), first, taken);
  take_evenly(all.subspan(size), count - first, taken);
}

/// Every so many of the nodes inside, so that there are several for each fiber.
std::vector<Vec3> seeds_in(const SolidGrid& grid, Index count) {
  constexpr Index seeds_of_fiber = 20, least = 3000;
  std::vector<Vec3> inside;
  for (Index n = 0; n < grid.count(); ++n)
    if (grid.depths()[static_cast<std::size_t>(n)] > 0) inside.emplace_back(grid.nodes().col(n));
  const auto wanted = static_cast<std::size_t>(std::max(least, seeds_of_fiber * count));
  if (inside.size() <= wanted) return inside;
  std::vector<Vec3> seeds;
  for (std::size_t i = 0; i < wanted; ++i) seeds.push_back(inside[i * inside.size() / wanted]);
  return seeds;
}

}  // namespace

std::vector<Points> evenly_traced(const FiberRoom& room, const FiberField& field, Index count) {
  const std::vector<Vec3> seeds = seeds_in(room.grid(), count);
  std::vector<Candidate> candidates(seeds.size());
  parallel_for(static_cast<Index>(seeds.size()), 16, [&](Index begin, Index end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      Candidate& each = candidates[i];
      each.line = traced_fiber(room, field, seeds[i]);
      if (each.line.cols() < 2) continue;
      each.length = polyline_length(each.line);
      each.middle = resampled(each.line, 2).col(1);
    }
  });
  std::erase_if(candidates, [](const Candidate& each) { return !(each.length > 0); });
  if (candidates.empty()) return {};
  std::vector<Real> lengths;
  for (const Candidate& each : candidates) lengths.push_back(each.length);
  std::nth_element(lengths.begin(), lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2), lengths.end());
  const Real median = lengths[lengths.size() / 2];
  std::vector<const Candidate*> all;
  for (Candidate& each : candidates) {
    each.section = 1 / each.length;
    if (each.length > median / 3) all.push_back(&each);
  }
  std::vector<Points> taken;
  take_evenly(all, count, taken);
  return taken;
}

}  // namespace gracilis
