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

/// Lets one component of the point's place follow the coordinate that predicts it best, as a polynomial that becomes a
/// spline through some of its values, unless none explains enough of its movement.
static void follow(const std::vector<FollowedCoordinate>& candidates, const Eigen::VectorXd& component, Real least_move,
                   FollowedComponent& followed) {
  const Real moves =
      std::sqrt((component.array() - component.mean()).square().sum() / static_cast<Real>(component.size()));
  if (moves < least_move) return;
  followed.left = moves;
  for (const FollowedCoordinate& candidate : candidates) {
    const Eigen::Map<const Eigen::VectorXd> values(candidate.values.data(), component.size());
    if (values.maxCoeff() - values.minCoeff() < 1e-4) continue;
    PathFitSettings settings;
    settings.largest_order = 6;
    const PathFit fit = fit_path({values, component}, settings);
    if (fit.left_out > 0.7 * moves || fit.left_out > 0.95 * followed.left) continue;
    const int knots = 2 * fit.function.order + 1;
    followed = {candidate.coordinate, {}, {}, fit.left_out};
    for (int k = 0; k < knots; ++k) {
      const Real share = static_cast<Real>(k) / (knots - 1);
      followed.knots.push_back((1 - share) * values.minCoeff() + share * values.maxCoeff());
      followed.values.push_back(value(fit.function, {followed.knots.back()}));
    }
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
    Real left = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::VectorXd component = places.row(static_cast<Eigen::Index>(i));
      point.follows[i].left = std::sqrt((component.array() - component.mean()).square().mean());
      if (point.moves > (end ? 5e-4 : 1e-5)) follow(moving, component, 1e-5, point.follows[i]);
      left += point.follows[i].left * point.follows[i].left;
    }
    point.left = std::sqrt(left);
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
    for (const FollowedComponent& component : fitted.follows) point.moving |= component.coordinate >= 0;
    for (std::size_t i = 0; i < 3 && point.moving; ++i) {
      const FollowedComponent& component = fitted.follows[i];
      point.moves_with[i] = component.coordinate;
      point.moves_to[i] = component.coordinate < 0 ? constant(fitted.location[static_cast<Eigen::Index>(i)])
                                                   : simm_spline(component.knots, component.values);
    }
    path.points.push_back(std::move(point));
  }
  return path;
}

}  // namespace gracilis::opensim
