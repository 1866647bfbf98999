#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/field_path.hpp>

#include <vector>

namespace gracilis {

/// What is done about particles so fast that they would pass through an obstacle.
enum class MotionGuard {
  none,
  turned_direction,  ///< goes back where the direction to the surface turned by more than 135 degrees (published)
  kept_path          ///< follows its path in the obstacle's frame and slides where the obstacle stands in the way
};

/// The gaps that points of a surface must keep from an obstacle, m. The gap in an edge or a face is that between its
/// corners' gaps, plus its sag. Gaps may be negative where the data overlap at rest.
struct ContactGaps {
  std::vector<float> particle;  ///< one per particle
  std::vector<float> edge_sag;  ///< at most 0, one per distance slot; empty: edges are not tested
  std::vector<float> face_sag;  ///< the same per face slot
};

/// The middle of an edge that keeps a gap of its own, m, whatever its ends keep.
struct EdgeMiddle {
  Index a, b;  ///< particles, one at least can move
  float gap;
};

/// Keeps particles, edges (those of the distance constraints) and large faces out of a rigid obstacle: C = d(x) - gap
/// >= 0, without compliance.
struct FieldContactSet {
  BoundedField field;          ///< in the obstacle's frame
  ContactGaps captured;        ///< in the capture pose
  ContactGaps released;        ///< once the obstacle has moved against the surface
  std::vector<float> ceiling;  ///< m, one per particle: the largest distance it may have; empty: none
  std::vector<EdgeMiddle> middles;
  MotionGuard guard = MotionGuard::kept_path;
};

/// Carries the particles' frame into the obstacle's: q = rotation x + translation.
struct FieldPlacement {
  Eigen::Matrix3f rotation = Eigen::Matrix3f::Identity();
  Eigen::Vector3f translation = Eigen::Vector3f::Zero();
  float release = 0;  ///< from the captured gaps (0) to the released ones (1)

  Eigen::Vector3f to_obstacle(const Eigen::Vector3f& x) const { return rotation * x + translation; }  ///< m
  /// The inverse of to_obstacle, m.
  Eigen::Vector3f from_obstacle(const Eigen::Vector3f& q) const { return rotation.transpose() * (q - translation); }
};

}  // namespace gracilis
