#pragma once

#include <gracilis/draft/skeleton.hpp>
#include <gracilis/geometry/thin_plate.hpp>
#include <gracilis/transfer/skeleton_fit.hpp>

#include <string>
#include <vector>

namespace gracilis {

/// How a joint came to lie in the subject.
struct JointTransfer {
  Guess guess;
  Real from_warp = 0;                 ///< m, of the center from where the warp alone puts it
  std::vector<std::string> captures;  ///< of each coordinate that the subject's pose changes: a sentence
};

/// The two skeletons as `draft` finds them, for joints whose shape tells where they are.
struct JointShapes {
  Skeleton of_template, of_subject;
};

/// Sets a joint's frame, capture values and ranges. Its center goes with the warp, its axes turn with the parent's
/// bones; where spheres, condyles or rollers are found on both template and subject, center and first axis lie to the
/// subject's as they did to the template's. Capture values follow from how the subject's bones stand to each other.
JointTransfer transfer_joint(const Scene& scene, const SkeletonFit& fit, const JointShapes& shapes,
                             const ThinPlateMap& warp, Joint& joint);

/// The coordinates' values at which a joint's axes turn by `rotation` (in the joint's frame) or as nearly so as they
/// can, found from the capture values on; those of translations stay.
std::vector<Real> nearest_values(const Joint& joint, const Eigen::Matrix3d& rotation);

}  // namespace gracilis
