#pragma once

#include <gracilis/geometry/signed_distance.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <vector>

namespace gracilis {

/// How deep muscles are in bones and in other muscles.
class ContactDepth {
 public:
  /// Of bones at rest.
  explicit ContactDepth(const std::vector<TriangleMesh>& bones);

  /// Per muscle and vertex of those listed: the depth (m) in whatever bone or other muscle it is deepest in; negative
  /// where it is apart from all, down to -3 mm. `moved` says where bones are, from rest. Muscles are whole surfaces.
  std::vector<std::vector<float>> of(const std::vector<TriangleMesh>& muscles,
                                     const std::vector<std::vector<Index>>& vertices,
                                     const std::vector<RigidTransform>& moved) const;

 private:
  std::vector<SignedDistance> bones_;
};

}  // namespace gracilis
