#pragma once

#include <gracilis/dynamics/contact/self/self_intersections.hpp>

#include <vector>

namespace gracilis {

/// Gives what cuts itself the shape that it had at rest: wherever cuts hang together, their corners and half of the
/// way those next to them, as the affine map nearest to how they and three rings around them lie now carries them. No
/// particle goes further than `most` (m).
void unfold(const ContactSurface& surface, const Eigen::Matrix3Xf& rest, const std::vector<FacePair>& cuts, float most,
            Particles& particles);

/// Moves the corners of what cuts itself, and those next to them, half of the way to the middle of their neighbors, so
/// many times over, each time no further than `most` (m).
void smooth(const ContactSurface& surface, const std::vector<FacePair>& cuts, int rounds, float most,
            Particles& particles);

/// Gives the corners of what cuts itself, and those next to them, their places beside their neighbors again: so many
/// times over, each goes half of the way to the middle of its neighbors and from there as it stood beside it at rest,
/// by the affine map nearest to how it and two rings around it lie now; each time no further than `most` (m). So it is
/// where the surface is thin for its edges, which smoothing shrinks; elsewhere this is smoothing.
void restore_shape(const ContactSurface& surface, const Eigen::Matrix3Xf& rest, const std::vector<FacePair>& cuts,
                   int rounds, float most, Particles& particles);

/// Moves what cuts itself, and what lies around it, as its surroundings moved from the prediction: so many times over,
/// each particle goes half of the way to where it was predicted and as far from there as its neighbors are on average;
/// each time no further than `most` (m). A prediction that does not cut itself is hardly tangled by that.
void smooth_motion(const ContactSurface& surface, const Particles& predicted, const std::vector<FacePair>& cuts,
                   int rounds, float most, Particles& particles);

}  // namespace gracilis
