#pragma once

#include <gracilis/core/types.hpp>

#include <vector>

namespace gracilis {

/// What a muscle's fibers do to the bodies in one pose, as the equilibrium says that they are in; empty for a muscle
/// without such fibers. World directions.
struct FiberActions {
  Eigen::MatrixXd arms;        ///< fibers × coordinates: -dL/dq, m per rad (of a translation m per m)
  std::vector<char> doubtful;  ///< per fiber: not at rest, or about to snap and so held where bodies carry it
  Eigen::VectorXd mean_arms;   ///< per coordinate, over all fibers, doubtful ones too
  /// 6 × bodies: the force (1) and the moment about the world's origin (m) with which the muscle pulls at each body,
  /// directly and through all that holds its fibers, at a tension of 1 that all fibers share equally.
  /// In the motion that a coordinate makes they work as much as its mean arm says.
  Eigen::MatrixXd wrenches;
  Points origin_directions, insertion_directions;  ///< per fiber, unit: how it pulls at its ends
};

}  // namespace gracilis
