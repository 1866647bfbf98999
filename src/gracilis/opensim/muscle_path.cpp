#include <gracilis/opensim/muscle_path.hpp>

#include <gracilis/opensim/wrapping.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gracilis::opensim {

using Poses = std::vector<RigidTransform>;

static const RigidTransform& pose_of(const Poses& poses, Index body) { return poses[static_cast<std::size_t>(body)]; }

static Vec3 location_of(const PathPoint& point, const Eigen::VectorXd& coordinates) {
  if (!point.moving) return point.location;
  Vec3 location;
  for (int i = 0; i < 3; ++i) {
    const auto component = static_cast<std::size_t>(i);
    const Index with = point.moves_with[component];
    location[i] = value(point.moves_to[component], {with < 0 ? 0 : coordinates[with]});
  }
  return location;
}

/// OpenSim lets a point act a little beyond its range.
static bool is_active(const PathPoint& point, const Eigen::VectorXd& coordinates) {
  const Real beyond = 1e-5;
  if (point.condition < 0) return true;
  const Real q = coordinates[point.condition];
  return q >= point.range_min - beyond && q <= point.range_max + beyond;
}

static Real length_of(const std::vector<CurrentPoint>& points) {
  Real length = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const bool arc = points[i].wrap >= 0 && points[i].wrap == points[i - 1].wrap;
    length += arc ? points[i].arc : (points[i].place - points[i - 1].place).norm();
  }
  return length;
}

/// The part of the current path, as indices of its points, in which a wrap object is tried; empty when none of the
/// given points that bound it is active.
static std::pair<std::size_t, std::size_t> range_of(const PathWrap& wrap, const Path& path,
                                                    const std::vector<CurrentPoint>& points) {
  const int first = std::max(wrap.first_point, 1) - 1;
  const int last = wrap.last_point < 1 ? static_cast<int>(path.points.size()) - 1 : wrap.last_point - 1;
  std::size_t begin = points.size(), end = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].given < first || points[i].given > last) continue;
    begin = std::min(begin, i);
    end = std::max(end, i);
  }
  return begin < end ? std::pair{begin, end} : std::pair<std::size_t, std::size_t>{0, 0};
}

/// Takes a wrap's two points out of the path and puts them in anew where the path needs them: at the first part that
/// cuts the object, or where holding it there lengthens the path least.
static Wrap::Kind apply_wrap(const Model& model, const Path& path, int index, const Poses& poses,
                             std::vector<CurrentPoint>& points) {
  std::erase_if(points, [&](const CurrentPoint& point) { return point.wrap == index; });
  const PathWrap& path_wrap = path.wraps[static_cast<std::size_t>(index)];
  const WrapObject& object = model.wrap_objects[static_cast<std::size_t>(path_wrap.object)];
  const RigidTransform frame = pose_of(poses, object.body) * object.frame, into = frame.inverse();
  const auto [begin, end] = range_of(path_wrap, path, points);
  Wrap best;
  std::size_t place = 0;
  Real least = std::numeric_limits<Real>::infinity();
  Wrap::Kind last = Wrap::Kind::none;
  for (std::size_t i = begin; i < end; ++i) {
    if (points[i].wrap >= 0 && points[i].wrap == points[i + 1].wrap) continue;
    const Vec3 a = into * points[i].place, b = into * points[i + 1].place;
    const Wrap wrap = wrap_around(object, a, b);
    last = wrap.kind;
    if (wrap.kind != Wrap::Kind::held && wrap.kind != Wrap::Kind::needed) continue;
    const Real change = (wrap.first - a).norm() + wrap.length + (b - wrap.last).norm() - (b - a).norm();
    if (wrap.kind == Wrap::Kind::needed || change < least) {
      best = wrap;
      place = i + 1;
      least = change;
    }
    if (wrap.kind == Wrap::Kind::needed) break;
  }
  if (place == 0) return last;
  CurrentPoint first, second;
  first.body = second.body = object.body;
  first.wrap = second.wrap = index;
  first.place = frame * best.first;
  second.place = frame * best.last;
  second.arc = best.length;
  points.insert(points.begin() + static_cast<std::ptrdiff_t>(place), {first, second});
  return best.kind;
}

std::vector<CurrentPoint> current_points(const Model& model, const Path& path, const Poses& poses,
                                         const Eigen::VectorXd& coordinates) {
  std::vector<CurrentPoint> points;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const PathPoint& point = path.points[i];
    if (!is_active(point, coordinates)) continue;
    CurrentPoint current;
    current.body = point.body;
    current.place = pose_of(poses, point.body) * location_of(point, coordinates);
    current.given = static_cast<int>(i);
    points.push_back(current);
  }
  const std::size_t count = path.wraps.size();
  std::vector<int> order(count);
  for (std::size_t i = 0; i < count; ++i) order[i] = static_cast<int>(i);
  std::vector<Wrap::Kind> kinds(count);
  Real before = std::numeric_limits<Real>::infinity();
  for (int pass = 0; pass < (count < 2 ? 1 : 8) && count > 0; ++pass) {
    for (std::size_t i = 0; i < count; ++i) kinds[i] = apply_wrap(model, path, order[i], poses, points);
    const Real length = length_of(points);
    if (std::abs(length - before) < 0.0005) break;
    before = length;
    // A point in the second object, the first not met: try them the other way round.
    if (pass == 0 && count > 1 && kinds[0] == Wrap::Kind::none && kinds[1] == Wrap::Kind::inside)
      std::swap(order[0], order[1]);
  }
  return points;
}

/// How the moving point's place in the ground frame changes with each coordinate, times a force on it.
static void add_moving_work(const Path& path, const CurrentPoint& current, const Vec3& force, const Poses& poses,
                            const Eigen::VectorXd& coordinates, Eigen::VectorXd& arms) {
  if (current.given < 0) return;
  const PathPoint& point = path.points[static_cast<std::size_t>(current.given)];
  if (!point.moving) return;
  const Vec3 in_body = pose_of(poses, point.body).linear().transpose() * force;
  for (int i = 0; i < 3; ++i) {
    const auto component = static_cast<std::size_t>(i);
    const Index with = point.moves_with[component];
    if (with >= 0) arms[with] += in_body[i] * derivative(point.moves_to[component], {coordinates[with]}, {0});
  }
}

static PathMeasure measure_function(const Skeleton& skeleton, const Path& path, const Eigen::VectorXd& coordinates) {
  std::vector<Real> arguments;
  for (const Index i : path.function_coordinates) arguments.push_back(coordinates[i]);
  PathMeasure measure{value(path.length_function, arguments), Eigen::VectorXd::Zero(coordinates.size())};
  for (std::size_t i = 0; i < arguments.size(); ++i)
    measure.moment_arms[path.function_coordinates[i]] -=
        derivative(path.length_function, arguments, {static_cast<int>(i)});
  measure.moment_arms = onto_independent(skeleton.model(), coordinates, measure.moment_arms);
  return measure;
}

PathMeasure measure_path(const Skeleton& skeleton, const Path& path, const Eigen::VectorXd& coordinates) {
  if (!path.function_coordinates.empty()) return measure_function(skeleton, path, coordinates);
  const Model& model = skeleton.model();
  const Poses& poses = skeleton.poses();
  const std::vector<CurrentPoint> points = current_points(model, path, poses, coordinates);
  BodyForces forces = BodyForces::Zero(6, static_cast<Eigen::Index>(poses.size()));
  Eigen::VectorXd arms = Eigen::VectorXd::Zero(coordinates.size());
  const auto pull = [&](const CurrentPoint& point, const Vec3& force) {
    add_force(forces, point.body, pose_of(poses, point.body), point.place, force);
    add_moving_work(path, point, force, poses, coordinates, arms);
  };
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i].wrap >= 0 && points[i].wrap == points[i - 1].wrap) continue;  // pulls on one body only
    const Vec3 along = points[i].place - points[i - 1].place;
    const Real length = along.norm();
    if (length == 0) continue;
    pull(points[i - 1], along / length);
    pull(points[i], -along / length);
  }
  arms += skeleton.generalized_forces(forces);
  return {length_of(points), onto_independent(model, coordinates, arms)};
}

}  // namespace gracilis::opensim
