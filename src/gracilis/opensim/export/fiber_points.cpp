#include <gracilis/opensim/export/fiber_points.hpp>

#include <gracilis/opensim/export/path_fit.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gracilis::opensim {

using FramePoses = std::vector<RigidTransform>;

/// The point's places in a body, 3 × frames.
static Points places_in(const std::vector<Points>& fibers, Eigen::Index point, const std::vector<FramePoses>& poses,
                        std::size_t body) {
  Points places(3, static_cast<Eigen::Index>(fibers.size()));
  for (std::size_t f = 0; f < fibers.size(); ++f)
    places.col(static_cast<Eigen::Index>(f)) = poses[f][body].inverse() * fibers[f].col(point);
  return places;
}

static Real movement(const Points& places) {
  const Points off = places.colwise() - places.rowwise().mean();
  return std::sqrt(off.squaredNorm() / static_cast<Real>(places.cols()));
}

/// One component of the point's place by a coordinate, as a polynomial that becomes a spline through some of its
/// values, unless that does not explain enough of its movement.
static FollowedComponent followed_component(const FollowedCoordinate& candidate, const Eigen::VectorXd& component) {
  FollowedComponent followed;
  followed.left = std::sqrt((component.array() - component.mean()).square().mean());
  const Eigen::Map<const Eigen::VectorXd> values(candidate.values.data(), component.size());
  const Real least = values.minCoeff(), most = values.maxCoeff();
  if (followed.left < 1e-5 || most - least < 1e-4) return followed;
  PathFitSettings settings;
  settings.largest_order = 6;
  const PathFit fit = fit_path({values, component}, settings);
  if (fit.left_out > 0.7 * followed.left) return followed;
  followed.left = fit.left_out;
  const int knots = 2 * fit.function.order + 1;
  for (int k = 0; k < knots; ++k) {
    const Real share = static_cast<Real>(k) / (knots - 1);
    followed.knots.push_back((1 - share) * least + share * most);
    followed.values.push_back(value(fit.function, {followed.knots.back()}));
  }
  return followed;
}

/// Lets the point follow the coordinate that predicts its place best. OpenSim refuses a point whose components depend
/// on several (MovingPathPoint), so that all of them take the same.
static void follow(const std::vector<FollowedCoordinate>& candidates, const Points& places, FiberPoint& point) {
  for (const FollowedCoordinate& candidate : candidates) {
    std::array<FollowedComponent, 3> follows;
    Real left = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      follows[i] = followed_component(candidate, places.row(static_cast<Eigen::Index>(i)).transpose());
      left = std::hypot(left, follows[i].left);
    }
    const bool some = std::any_of(follows.begin(), follows.end(), [](const auto& each) { return !each.knots.empty(); });
    if (!some || (point.coordinate >= 0 && left > 0.95 * point.left)) continue;
    point.coordinate = candidate.coordinate;
    point.follows = std::move(follows);
    point.left = left;
  }
}

std::vector<FiberPoint> fit_points(const std::vector<Points>& fibers, const std::vector<FramePoses>& poses,
                                   const std::vector<FollowedCoordinate>& moving) {
  std::vector<FiberPoint> result;
  const Eigen::Index count = fibers.front().cols();
  for (Eigen::Index p = 0; p < count; ++p) {
    FiberPoint point;
    Points places = places_in(fibers, p, poses, 0);
    point.moves = movement(places);
    // A body that does not move beside the ground is the better home.
    for (std::size_t body = 1; body < poses.front().size(); ++body) {
      const Points here = places_in(fibers, p, poses, body);
      const Real moves = movement(here);
      if (moves > point.moves - (point.body == 0 ? -1e-9 : 1e-9)) continue;
      point.body = static_cast<Index>(body);
      point.moves = moves;
      places = here;
    }
    point.location = places.rowwise().mean();
    const bool end = p == 0 || p + 1 == count;
    point.left = point.moves;
    if (point.moves > (end ? 5e-4 : 1e-5)) follow(moving, places, point);
    result.push_back(std::move(point));
  }
  return result;
}

Path path_of(const std::vector<FiberPoint>& points) {
  Path path;
  for (const FiberPoint& fitted : points) {
    PathPoint point;
    point.name = fmt::format("p{}", path.points.size() + 1);
    point.body = fitted.body;
    point.location = fitted.location;
    point.moving = fitted.coordinate >= 0;
    for (std::size_t i = 0; i < 3 && point.moving; ++i) {
      const FollowedComponent& component = fitted.follows[i];
      const bool stays = component.knots.empty();
      point.moves_with[i] = stays ? -1 : fitted.coordinate;
      point.moves_to[i] = stays ? constant(fitted.location[static_cast<Eigen::Index>(i)])
                                : simm_spline(component.knots, component.values);
    }
    path.points.push_back(std::move(point));
  }
  return path;
}

}  // namespace gracilis::opensim
