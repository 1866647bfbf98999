#pragma once

#include <gracilis/opensim/export/path_samples.hpp>
#include <gracilis/opensim/kinematics/skeleton.hpp>

#include <vector>

namespace gracilis::opensim {

/// Ranges of some of a model's coordinates, rad or m.
struct CoordinateBox {
  std::vector<Index> coordinates;
  Eigen::VectorXd least, most;

  /// Per coordinate what PathSamples::scales asks for.
  Eigen::VectorXd scales(const Model& model) const;
};

/// Poses spread over the box (sobol_points), a row each; `skip` as there.
Eigen::MatrixXd spread_poses(const CoordinateBox& box, Eigen::Index count, Eigen::Index skip = 0);

/// Lengths and arms of a path where the box's coordinates have these values, a row per pose, and the others their
/// default ones.
PathSamples model_samples(Skeleton& skeleton, const Path& path, const CoordinateBox& box, const Eigen::MatrixXd& poses);

/// Where a run's poses lie, its values of these coordinates widened by `margin` (rad) or a tenth of a translation's way
/// on both sides, but not beyond the model's ranges, which a run may have left; with `whole_ranges` all of these.
CoordinateBox box_around(const Model& model, const std::vector<Index>& coordinates, const Eigen::MatrixXd& values,
                         bool whole_ranges, Real margin = radians(10));

}  // namespace gracilis::opensim
