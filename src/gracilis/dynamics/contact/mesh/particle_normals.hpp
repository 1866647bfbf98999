#pragma once

#include <gracilis/dynamics/contact/mesh/contact_surface.hpp>

#include <vector>

namespace gracilis {

/// Unit normals at the particles, sums of the faces' normals weighted by their angles there (Bærentzen and Aanæs 2005);
/// zero where all faces are flat.
void particle_normals(const ContactSurface& surface, const Particles& particles, Eigen::Matrix3Xf& normals);
/// The same for the particles listed; the others keep what they have.
void particle_normals(const ContactSurface& surface, const Particles& particles, const std::vector<Index>& listed,
                      Eigen::Matrix3Xf& normals);

}  // namespace gracilis
