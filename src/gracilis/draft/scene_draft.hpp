#pragma once

#include <gracilis/draft/draft_attachments.hpp>
#include <gracilis/draft/found_surfaces.hpp>
#include <gracilis/draft/skeleton.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gracilis {

struct DraftOptions {
  std::map<std::string, std::vector<std::string>> joint_landmarks = {};  ///< names of one or two landmarks, by joint
  bool mirror = false;                                                   ///< make the other half of the body
  std::string unit = {};   ///< of all files; empty: found by the bones' sizes
  MendFunction mend = {};  ///< of muscles that a run would refuse or that have flaws; none: the former are left out
  std::filesystem::path mended_folder = {};  ///< where those are to be written
};

/// One coordinate of the default motion.
struct DraftMotion {
  std::string coordinate;
  Real from = 0, to = 0;  ///< rad
};

/// A scene made of a folder of surfaces: what is there, and what was guessed about it.
struct SceneDraft {
  FoundFolder found;
  Skeleton skeleton;
  std::vector<DraftMuscle> muscles;
  std::vector<DraftMotion> motion;
  std::vector<Guess> guesses;         ///< of all but attachments, which hold their own
  std::vector<std::string> left_out;  ///< a line each
};

/// Throws InputError where the folder holds no bones, no muscle that a scene could have, or nothing that moves, and
/// ConfigurationError where options name what is not there.
SceneDraft draft_scene(const std::filesystem::path& folder, const DraftOptions& options = {});

/// The same of files listed; `subject` names them in messages.
SceneDraft draft_scene(const FolderFiles& files, const std::filesystem::path& subject,
                       const DraftOptions& options = {});

/// Only what the files' names tell: bones that each are a body of their own, and muscles that are attached to nothing.
/// Throws InputError where there is no unit among the options and no bone whose size tells one.
SceneDraft draft_without_joints(const FolderFiles& files, const DraftOptions& options);

}  // namespace gracilis
