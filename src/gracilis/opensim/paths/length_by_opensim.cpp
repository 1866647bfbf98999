#include <gracilis/opensim/paths/length_by_opensim.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace gracilis::opensim {

using Vec2 = Eigen::Vector2d;

/// How high the plane cuts the line of tangency of `point`; as high as the point itself where that is nearer to the
/// other point's height, or where the plane stands along the axis.
static Real height_of_touch(const Vec3& normal, const Vec3& point, const Vec3& other, const Vec2& tangent) {
  const Real cut = point.z() - normal.head<2>().dot(tangent - point.head<2>()) / normal.z();
  return std::abs(cut - other.z()) < std::abs(point.z() - other.z()) ? cut : point.z();
}

Wrap cylinder_by_opensim(const WrapSurface& cylinder, const Vec3& a, const Vec3& b) {
  WrapSurface endless = cylinder;
  endless.length = std::numeric_limits<Real>::infinity();
  Wrap wrap = wrap_around(endless, a, b);
  if (!wrap.touches() || std::abs(wrap.way.sweep) > pi) return wrap_around(cylinder, a, b);
  const Real from_a = a.head<2>().norm(), from_b = b.head<2>().norm();
  const Vec3 on_axis(0, 0, a.z() + from_a / (from_a + from_b) * (b.z() - a.z()));
  const Vec3 normal = (a - on_axis).cross(b - on_axis);
  const Real first = height_of_touch(normal, a, b, wrap.first().head<2>());
  const Real last = height_of_touch(normal, b, a, wrap.last().head<2>());
  wrap.way.center.z() = first;
  wrap.way.climb.z() = last - first;
  wrap.length = std::hypot(cylinder.radius * wrap.way.sweep, last - first);
  const Real half = cylinder.length / 2;
  if (std::abs(first) > half && std::abs(last) > half) wrap.kind = Wrap::Kind::none;
  return wrap;
}

namespace {

/// What OpenSim sums: to straight parts, a point on a surface stays where the round that first brought it has put it,
/// while arcs are those of the last round.
class SumOfRounds {
 public:
  Real operator()(const std::vector<PathStop>& points) {
    Real sum = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const PathStop &from = points[i - 1], &to = points[i];
      const bool arc = to.wrap >= 0 && to.wrap == from.wrap;
      sum += arc ? to.around.length : (first_place(to, Side::meets) - first_place(from, Side::leaves)).norm();
    }
    return sum;
  }

 private:
  enum class Side { meets, leaves };

  const Vec3& first_place(const PathStop& stop, Side side) {
    if (stop.wrap < 0) return stop.place;
    return places_.try_emplace({stop.wrap, side}, stop.place).first->second;
  }

  std::map<std::pair<int, Side>, Vec3> places_;
};

}  // namespace

static Wrap lone_wrap(const PlacedWrap& wrap, const Vec3& a, const Vec3& b) {
  if (wrap.surface.kind == WrapSurface::Kind::cylinder) return cylinder_by_opensim(wrap.surface, a, b);
  return wrap_around(wrap.surface, a, b, wrap.plane);
}

static bool is_obstacle(const PlacedWrap& wrap) { return wrap.surface.hand != 0; }

Real length_by_opensim(const Skeleton& skeleton, const Path& path, const Eigen::VectorXd& coordinates) {
  if (!path.function_coordinates.empty()) return measure_path(skeleton, path, coordinates).length;
  const std::vector<PlacedWrap> wraps = placed_wraps(skeleton.model(), path, skeleton.poses());
  std::vector<PathStop> points = own_points(skeleton.model(), path, skeleton.poses(), coordinates);
  SumOfRounds sum;
  PathSolver solver;
  if (std::none_of(wraps.begin(), wraps.end(), is_obstacle)) {
    if (wraps.size() == 1) solver.wrap = lone_wrap;
    solver.length = [&sum](const std::vector<PathStop>& now) { return sum(now); };
  }
  solve_path(wraps, points, solver);
  return solver.length(points);
}

}  // namespace gracilis::opensim
