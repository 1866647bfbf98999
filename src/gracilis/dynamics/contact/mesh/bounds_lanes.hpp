#pragma once

#include <gracilis/core/aligned.hpp>
#include <gracilis/dynamics/contact/mesh/patch_tree.hpp>

#include <array>

namespace gracilis {

/// The bounds of some patches side by side, so that many are asked at once.
struct BoundsLanes {
  using Rows = std::array<AlignedVector<float>, 3>;  ///< x, y and z

  std::vector<Index> nodes;
  Rows low, high, low_normal, high_normal;  ///< one entry per node, and what fills up the last group: nowhere

  /// Takes the bounds of these nodes of the tree.
  void load(const PatchTree& tree, const std::vector<Index>& patches);
};

/// Those of the patches that may meet what is within `near` by the rule of may_meet.
void find_meeting_patches(const BoundsLanes& bounds, const PatchTree::Bounds& near, float reach,
                          std::vector<Index>& patches);

/// A patch and how far its box is from a point.
struct NearPatch {
  Index node = 0;
  float distance2 = 0;  ///< m²
};

/// The patches within `reach` (m) of p that may face against `outward`, or whichever way they face when that is zero.
void find_near_patches(const BoundsLanes& bounds, const Eigen::Vector3f& p, const Eigen::Vector3f& outward, float reach,
                       std::vector<NearPatch>& near);

}  // namespace gracilis
