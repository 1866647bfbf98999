#include <gracilis/anatomy/sections/line_path.hpp>

namespace gracilis {

static const RigidTransform& motion_of(const Pose& pose, Index body) {
  return pose.bodies[static_cast<std::size_t>(body)];
}

static Real value_of(const LineCoordinate& coordinate, const Pose& pose) {
  const auto index = static_cast<std::size_t>(coordinate.index);
  return coordinate.index >= 0 && index < pose.coordinates.size() ? pose.coordinates[index] : coordinate.capture;
}

/// OpenSim lets a point act a little beyond its range.
static bool is_there(const LinePoint& point, const Pose& pose) {
  const Real beyond = 1e-5;
  if (point.condition.index < 0) return true;
  const Real value = value_of(point.condition, pose);
  return value >= point.range_min - beyond && value <= point.range_max + beyond;
}

static Vec3 place_of(const LinePoint& point, const Pose& pose) {
  if (!point.moving) return motion_of(pose, point.body) * point.place;
  Vec3 in_frame;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto component = static_cast<std::size_t>(i);
    in_frame[i] = value_at(point.moves_to[component], value_of(point.moves_with[component], pose));
  }
  return motion_of(pose, point.body) * point.frame * in_frame;
}

static Points own_points(const ActionLine& line, const Pose& pose) {
  Points points(3, line.points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    points.col(i) = motion_of(pose, line.bodies[static_cast<std::size_t>(i)]) * line.points.col(i);
  return points;
}

Points line_at(const ActionLine& line, const Pose& pose) {
  std::vector<PathStop> stops;
  for (std::size_t i = 0; i < line.path.points.size(); ++i) {
    const LinePoint& point = line.path.points[i];
    if (!is_there(point, pose)) continue;
    PathStop stop;
    stop.body = point.body;
    stop.place = place_of(point, pose);
    stop.given = static_cast<int>(i);
    stops.push_back(stop);
  }
  std::vector<PlacedWrap> wraps = line.path.wraps;
  for (PlacedWrap& wrap : wraps) wrap.frame = motion_of(pose, wrap.body) * wrap.frame;
  solve_path(wraps, stops);
  const Points points = line_through(stops, wraps, radians(5));
  return points.cols() < 2 ? own_points(line, pose) : points;
}

}  // namespace gracilis
