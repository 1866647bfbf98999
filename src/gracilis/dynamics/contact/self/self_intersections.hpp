#pragma once

#include <gracilis/dynamics/contact/mesh/contact_surface.hpp>

#include <array>
#include <vector>

namespace gracilis {

/// Two faces, the lower number first.
using FacePair = std::array<Index, 2>;

/// Appends the faces around those edges at which a surface is folded by more than a right angle.
void gather_folded(const ContactSurface& surface, const Particles& particles, std::vector<Index>& faces);

/// Which of these faces of one surface cut each other, but did so neither at `rest` nor `before`; each pair once, in
/// order. Two that share a side never do; two that share a corner do when the side opposite to it passes through the
/// other. Pairs that cannot move are left out. Looks at so many pairs per face of the surface at most; a surface that
/// has more to look at is a tangle, of which the rest is left out.
std::vector<FacePair> find_self_intersections(const ContactSurface& surface, const Eigen::Matrix3Xf& rest,
                                              const Particles& before, const Particles& particles,
                                              std::vector<Index> faces);

/// Which neighboring faces have folded: turned about their common side by more than a right angle since `rest`, but not
/// `before`; each pair once, in order. Faces less than 45 degrees from flat have straightened, not folded. Pairs that
/// cannot move are left out.
std::vector<FacePair> find_folds(const ContactSurface& surface, const Eigen::Matrix3Xf& rest, const Particles& before,
                                 const Particles& particles);

}  // namespace gracilis
