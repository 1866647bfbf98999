#pragma once

#include <gracilis/opensim/import/bone_clearance.hpp>

namespace gracilis::opensim {

/// Rays of `lengths` (rays × sections, m) drawn in until edges between corners, too, lie outside of the bones: corners
/// that do say nothing of a ridge between them, out of which the first frames would tear the muscle. A ray keeps two
/// fifths of its length, so what no drawing in brings out stays; so do edges at ends, which grow out of bones.
Eigen::MatrixXd drawn_off_ridges(const SectionRays& rays, Eigen::MatrixXd lengths, const std::vector<SolidBone>& bones);

}  // namespace gracilis::opensim
