#pragma once

#include <gracilis/dynamics/contact/mesh/contact_surface.hpp>

namespace gracilis {

/// How two parts of the same surface may meet: 1 from outside where the surface folds, -1 from inside where it is a
/// sheet and the one the other's back, 0 not at all because they are the same place or lie side by side. What faced
/// each other or lay back to back at rest stays so; elsewhere the places before the step tell.
struct SelfRule {
  const ContactSurface& surface;
  const Eigen::Matrix3Xf &rest, &rest_normals;
  const Particles &before, &particles;
  float neighborhood;  ///< m

  /// For a particle and a face that face against each other now; 0 for others.
  float side(Index particle, Index face) const;
  /// The same without looking whether they do.
  float side_when_facing(Index particle, Index face) const;
  /// For two edges, given by their ends.
  float side(const std::array<Index, 2>& edge, const std::array<Index, 2>& other) const;
  /// Parts near each other at rest keep less than the margin, m.
  float most_gap(Index particle, Index face) const;
  /// The same for two edges, given by their ends.
  float most_gap(const std::array<Index, 2>& edge, const std::array<Index, 2>& other) const;
};

}  // namespace gracilis
