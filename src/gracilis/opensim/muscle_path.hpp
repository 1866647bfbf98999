#pragma once

#include <gracilis/opensim/skeleton.hpp>

#include <vector>

namespace gracilis::opensim {

/// A point that a path runs through now.
struct CurrentPoint {
  Index body = 0;
  Vec3 place = Vec3::Zero();  ///< in the ground frame
  int given = -1;             ///< index among Path::points; -1: where it meets or leaves a wrap object
  int wrap = -1;              ///< index among Path::wraps; two neighbors of the same one have an arc between them
  Real arc = 0;               ///< m, length on the wrap object up to this point; on the second of the two
};

/// Where a path runs for the bodies at `poses` and these coordinates: its active points, and where it touches wrap
/// objects. These are tried in order, up to eight times where there are several, as OpenSim does.
std::vector<CurrentPoint> current_points(const Model& model, const Path& path, const std::vector<RigidTransform>& poses,
                                         const Eigen::VectorXd& coordinates);

/// A path's length (m), and its moment arms: -dL/dq for every coordinate (m per rad, or per m), by virtual work of a
/// unit tension (Sherman, Seth, Delp 2013). Coupled coordinates' arms are taken into those they depend on.
struct PathMeasure {
  Real length = 0;
  Eigen::VectorXd moment_arms;
};

/// Measures a path for the skeleton as placed at `coordinates`. The coordinates must obey the couplers.
PathMeasure measure_path(const Skeleton& skeleton, const Path& path, const Eigen::VectorXd& coordinates);

}  // namespace gracilis::opensim
