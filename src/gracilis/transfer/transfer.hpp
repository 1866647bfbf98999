#pragma once

#include <gracilis/transfer/joint_transfer.hpp>
#include <gracilis/transfer/muscle_transfer.hpp>
#include <gracilis/transfer/skeleton_fit.hpp>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace gracilis {

/// A template's muscles and joints on a subject's bones.
struct TransferOptions {
  std::optional<BodySide> side;         ///< of the subject to make; none: the template's, or the one that is there
  NamedLandmarks landmarks;             ///< m; the template's in its frame
  std::map<std::string, Real> volumes;  ///< m³, of the subject's muscles by name
  SeparateFunction separate;            ///< empty: overlaps stay
  std::function<void(const std::string&)> say;
};

struct Transferred {
  Scene scene;           ///< the subject's: bones, joints and muscles that could be carried
  Scene whole_template;  ///< mirrored where the subject's side is the other one
  bool is_mirrored = false;
  FoundFolder subject;
  BoneMatches matches;
  SkeletonFit skeleton;
  ThinPlateMap warp;
  TransferredMuscles muscles;         ///< of `scene`
  std::vector<JointTransfer> joints;  ///< of `scene`
  std::vector<std::string> left_out;  ///< a line each: what could not be carried, and why
  Real overlap_left = 0;              ///< m by which the worst gap is missed after pulling apart
  std::vector<Guess> guesses;
};

/// Throws InputError where no bone of the template is in the folder, where names are exchanged, and where nothing that
/// moves could be carried; ConfigurationError where volumes or landmarks name what is not there.
Transferred transfer(const Scene& scene, FoundFolder subject, const TransferOptions& options);

}  // namespace gracilis
