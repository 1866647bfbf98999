#include <gracilis/opensim/paths/muscle_path.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis::opensim {

using Poses = std::vector<RigidTransform>;

static const RigidTransform& pose_of(const Poses& poses, Index body) { return poses[static_cast<std::size_t>(body)]; }

static Real within_range(const Model& model, Index index, const Eigen::VectorXd& coordinates) {
  const Coordinate& coordinate = model.coordinates[static_cast<std::size_t>(index)];
  return std::min(std::max(coordinates[index], coordinate.range_min), coordinate.range_max);
}

Vec3 location_of(const Model& model, const PathPoint& point, const Eigen::VectorXd& coordinates) {
  if (!point.moving) return point.location;
  Vec3 location;
  for (int i = 0; i < 3; ++i) {
    const auto component = static_cast<std::size_t>(i);
    const Index with = point.moves_with[component];
    location[i] = value(point.moves_to[component], {with < 0 ? 0 : within_range(model, with, coordinates)});
  }
  return location;
}

/// OpenSim lets a point act a little beyond its range.
bool is_active(const PathPoint& point, const Eigen::VectorXd& coordinates) {
  const Real beyond = 1e-5;
  if (point.condition < 0) return true;
  const Real q = coordinates[point.condition];
  return q >= point.range_min - beyond && q <= point.range_max + beyond;
}

std::vector<PlacedWrap> placed_wraps(const Model& model, const Path& path, const Poses& poses) {
  std::vector<PlacedWrap> wraps;
  for (const PathWrap& wrap : path.wraps) {
    const WrapObject& object = model.wrap_objects[static_cast<std::size_t>(wrap.object)];
    const int last = wrap.last_point < 1 ? static_cast<int>(path.points.size()) : wrap.last_point;
    wraps.push_back({object.surface, pose_of(poses, object.body) * object.frame, object.body,
                     std::max(wrap.first_point, 1) - 1, last - 1, wrap.plane});
  }
  return wraps;
}

std::vector<PathStop> own_points(const Model& model, const Path& path, const Poses& poses,
                                 const Eigen::VectorXd& coordinates) {
  std::vector<PathStop> points;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const PathPoint& point = path.points[i];
    if (!is_active(point, coordinates)) continue;
    PathStop current;
    current.body = point.body;
    current.place = pose_of(poses, point.body) * location_of(model, point, coordinates);
    current.given = static_cast<int>(i);
    points.push_back(current);
  }
  return points;
}

std::vector<PathStop> current_points(const Model& model, const Path& path, const Poses& poses,
                                     const Eigen::VectorXd& coordinates) {
  std::vector<PathStop> points = own_points(model, path, poses, coordinates);
  solve_path(placed_wraps(model, path, poses), points);
  return points;
}

/// How the moving point's place in the ground frame changes with each coordinate, times a force on it.
static void add_moving_work(const Skeleton& skeleton, const Path& path, const PathStop& current, const Vec3& force,
                            const Eigen::VectorXd& coordinates, Eigen::VectorXd& arms) {
  if (current.given < 0) return;
  const PathPoint& point = path.points[static_cast<std::size_t>(current.given)];
  if (!point.moving) return;
  const Vec3 in_body = pose_of(skeleton.poses(), point.body).linear().transpose() * force;
  for (int i = 0; i < 3; ++i) {
    const auto component = static_cast<std::size_t>(i);
    const Index with = point.moves_with[component];
    if (with >= 0 && within_range(skeleton.model(), with, coordinates) == coordinates[with])
      arms[with] += in_body[i] * derivative(point.moves_to[component], {coordinates[with]}, {0});
  }
}

static std::vector<Real> arguments_of(const Path& path, const Eigen::VectorXd& coordinates) {
  std::vector<Real> arguments;
  for (const Index i : path.function_coordinates) arguments.push_back(coordinates[i]);
  return arguments;
}

static AppliedForces function_pull(const Skeleton& skeleton, const Path& path, const Eigen::VectorXd& coordinates) {
  const std::vector<Real> arguments = arguments_of(path, coordinates);
  AppliedForces pull(skeleton.model());
  for (std::size_t i = 0; i < arguments.size(); ++i)
    pull.coordinates[path.function_coordinates[i]] -=
        derivative(path.length_function, arguments, {static_cast<int>(i)});
  return pull;
}

static AppliedForces pull_through(const Skeleton& skeleton, const Path& path, const std::vector<PathStop>& points,
                                  const Eigen::VectorXd& coordinates) {
  const Poses& poses = skeleton.poses();
  AppliedForces forces(skeleton.model());
  const auto pull = [&](const PathStop& point, const Vec3& force) {
    add_force(forces.bodies, point.body, pose_of(poses, point.body), point.place, force);
    add_moving_work(skeleton, path, point, force, coordinates, forces.coordinates);
  };
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i].wrap >= 0 && points[i].wrap == points[i - 1].wrap) continue;  // pulls on one body only
    const Vec3 along = points[i].place - points[i - 1].place;
    const Real length = along.norm();
    if (length == 0) continue;
    pull(points[i - 1], along / length);
    pull(points[i], -along / length);
  }
  return forces;
}

AppliedForces unit_pull(const Skeleton& skeleton, const Path& path, const Eigen::VectorXd& coordinates) {
  if (!path.function_coordinates.empty()) return function_pull(skeleton, path, coordinates);
  return pull_through(skeleton, path, current_points(skeleton.model(), path, skeleton.poses(), coordinates),
                      coordinates);
}

PathMeasure measure_path(const Skeleton& skeleton, const Path& path, const Eigen::VectorXd& coordinates) {
  const Model& model = skeleton.model();
  if (!path.function_coordinates.empty()) {
    const AppliedForces pull = function_pull(skeleton, path, coordinates);
    return {value(path.length_function, arguments_of(path, coordinates)),
            onto_independent(model, coordinates, pull.coordinates)};
  }
  const std::vector<PathStop> points = current_points(model, path, skeleton.poses(), coordinates);
  const AppliedForces pull = pull_through(skeleton, path, points, coordinates);
  return {length_of(points), onto_independent(model, coordinates, skeleton.generalized_forces(pull))};
}

}  // namespace gracilis::opensim
