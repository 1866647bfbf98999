#pragma once

#include <gracilis/geometry/wrapped_path.hpp>
#include <gracilis/opensim/kinematics/skeleton.hpp>

#include <vector>

namespace gracilis::opensim {

/// Where a point lies in its body, and whether the path runs through it. Beyond the range of its coordinate a moving
/// point stays where the range ends, as in OpenSim.
Vec3 location_of(const Model& model, const PathPoint& point, const Eigen::VectorXd& coordinates);
/// Whether the path runs through it: at a condition, where its coordinate is within the range.
bool is_active(const PathPoint& point, const Eigen::VectorXd& coordinates);

/// The surfaces that a path may run around, for the bodies at `poses`.
std::vector<PlacedWrap> placed_wraps(const Model& model, const Path& path, const std::vector<RigidTransform>& poses);

/// The points of a path's own that it runs through now.
std::vector<PathStop> own_points(const Model& model, const Path& path, const std::vector<RigidTransform>& poses,
                                 const Eigen::VectorXd& coordinates);

/// Where a path runs for the bodies at `poses` and these coordinates: its active points, and where it touches wrap
/// objects (geometry/wrapped_path).
std::vector<PathStop> current_points(const Model& model, const Path& path, const std::vector<RigidTransform>& poses,
                                     const Eigen::VectorXd& coordinates);

/// The length of a path's way (m; OpenSim's own number: length_by_opensim), and its moment arms: -dL/dq for every
/// coordinate (m per rad, or per m), by virtual work of a unit tension (Sherman, Seth, Delp 2013). Coupled coordinates'
/// arms are taken into those they depend on. Beyond its coordinate's range a moving point does no work of its own,
/// since it stays; OpenSim's moment arms there still have its slope (MovingPathPoint::getdPointdQ), its lengths do not.
struct PathMeasure {
  Real length = 0;
  Eigen::VectorXd moment_arms;
};

/// What a unit tension along the path does: its pulls on bodies, and the work of points that move with coordinates. A
/// path that is a function of coordinates pulls on these alone.
AppliedForces unit_pull(const Skeleton& skeleton, const Path& path, const Eigen::VectorXd& coordinates);

/// Measures a path for the skeleton as placed at `coordinates`. The coordinates must obey the couplers.
PathMeasure measure_path(const Skeleton& skeleton, const Path& path, const Eigen::VectorXd& coordinates);

}  // namespace gracilis::opensim
