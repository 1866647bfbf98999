#pragma once

#include <gracilis/dynamics/surface_contact.hpp>

namespace gracilis {

/// How a particle and a face of the same surface may meet.
struct SelfRule {
  const ContactSurface& surface;
  const Eigen::Matrix3Xf &rest, &rest_normals;
  const Particles& particles;
  float neighborhood;  ///< m

  /// 1 from outside where the surface folds, -1 from inside where it is a sheet and the face its back, 0 not at all
  /// because they are neighbors, lie side by side or face the same way.
  float side(Index particle, Index face) const;
  /// What their places at rest allow.
  float side_at_rest(Index particle, Index face) const;
};

SelfRule self_rule(const SurfaceCrowd& crowd, const Particles& particles, Index surface);

}  // namespace gracilis
