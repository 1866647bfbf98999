#pragma once

#include <gracilis/draft/joint_fits.hpp>

namespace gracilis {

/// The joint between two vertebrae (kinds `disc` and `masses`): where their end plates, or the joints' surfaces on both
/// sides, face each other. Up is at right angles to these, right that of the two bones' own symmetry. Nothing where
/// they do not face each other.
std::optional<JointFit> fit_vertebrae(const JointQuestion& question);

}  // namespace gracilis
