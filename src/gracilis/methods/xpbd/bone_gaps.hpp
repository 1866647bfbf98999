#pragma once

#include <gracilis/methods/xpbd/preparation.hpp>

namespace gracilis::xpbd {

/// Which gaps the particles, edges and large faces of `prepared` must keep from a bone, in the capture pose and once
/// the bone has moved against the muscle. `topology` is in particle numbers. Preconditions: positions, attachments,
/// distances and large faces of `prepared` are there.
FieldContactSet bone_contact(const PreparedMuscle& prepared, const MeshTopology& topology, const Bone& bone,
                             const DistanceField& field);

}  // namespace gracilis::xpbd
