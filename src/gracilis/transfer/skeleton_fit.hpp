#pragma once

#include <gracilis/transfer/bone_match.hpp>
#include <gracilis/transfer/bone_registration.hpp>
#include <gracilis/transfer/transfer_inputs.hpp>

#include <functional>
#include <string>
#include <vector>

namespace gracilis {

/// A bone of the template laid on the subject's.
struct FittedBone {
  BoneMatch match;
  RegisteredBone registered;
};

struct SkeletonFit {
  std::vector<FittedBone> bones;      ///< in the order of matches
  std::vector<Similarity> bodies;     ///< of the scene's bodies; those without bones as their nearest parent's
  std::vector<char> has_bones;        ///< of the scene's bodies
  std::vector<std::string> doubtful;  ///< a sentence each: what fits badly
};

/// Those of one name belong together.
struct NamedLandmarks {
  LandmarkPoints of_template, of_subject;
};

/// Bones of one body first as one, from the turns that the two bodies' directions (`turn`), landmarks and principal
/// axes give; then one by one. `say` is told what takes long. Throws InputError where bones of two names fit each
/// other's places better than their own.
SkeletonFit fit_skeleton(const Scene& scene, const FoundFolder& subject, const std::vector<BoneMatch>& matches,
                         const Eigen::Matrix3d& turn, const NamedLandmarks& landmarks,
                         const std::function<void(const std::string&)>& say);

}  // namespace gracilis
