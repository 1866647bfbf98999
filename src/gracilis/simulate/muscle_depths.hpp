#pragma once

#include <gracilis/anatomy/overlap/rest_overlap.hpp>
#include <gracilis/geometry/mutual_depths.hpp>
#include <gracilis/scene/frame.hpp>
#include <gracilis/scene/scene.hpp>

#include <vector>

namespace gracilis {

/// How deep the deepest of a muscle's free vertices lies in another, beyond how deep these two lie in each other at
/// rest around it.
struct DepthBeyondRest {
  Real depth = 0;    ///< m
  Index other = -1;  ///< the muscle that it lies in; -1 where none does
};

/// Measures how deep muscles lie in each other. What two muscles overlap by at rest is forgiven the vertices that are
/// within `slide_reach` of it then, since muscles slide along each other.
class MuscleDepths {
 public:
  /// The scene must outlive this.
  explicit MuscleDepths(const Scene& scene);

  /// Per muscle. Precondition: all points are finite.
  std::vector<DepthBeyondRest> beyond_rest(const Frame& frame) const;

 private:
  std::vector<DepthInOther> depths_of(const std::vector<Points>& points) const;
  std::size_t pair_of(const DepthInOther& each) const;
  Vec3 place_at_rest(const DepthInOther& each) const;

  const Scene& scene_;
  std::vector<std::vector<char>> attached_;  ///< per muscle and vertex
  MutualDepths surfaces_;
  std::vector<std::vector<DepthAtRest>> overlaps_;  ///< by pair_of
};

}  // namespace gracilis
