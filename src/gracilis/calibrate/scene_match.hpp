#pragma once

#include <gracilis/calibrate/calibration.hpp>
#include <gracilis/io/scene/scene_reader.hpp>

namespace gracilis {

/// What a scene says about a calibration of it.
struct SceneMatch {
  std::vector<Real> starts;         ///< per parameter: as the file says, else what the scene has
  std::vector<char> whole;          ///< per parameter: it takes whole numbers only
  std::vector<std::string> absent;  ///< muscles that a target's file tells of and the scene does not have
  std::string inputs;               ///< the scene's files and their hashes, a line each
};

/// Compares targets and parameters with the scene that they are about. Throws ConfigurationError with all problems:
/// muscles, coordinates and settings that are not there, settings that are no numbers, bounds that a setting may not
/// have.
SceneMatch match_scene(const Calibration& calibration, const LoadedScene& loaded);

/// Across processes.
std::string to_text(const SceneMatch& match);
/// What to_text wrote. Throws InputError where it is not that.
SceneMatch match_from_text(const std::string& text);

/// Leaves out what the scene does not have.
void drop_absent(Calibration& calibration, const std::vector<std::string>& absent);

/// A setting as `--set` names it: KEY, MUSCLE.KEY, contact.KEY, distance_field.KEY, sequence.KEY, fibers.KEY,
/// contraction.KEY or prepare.KEY.
struct SettingLookup {
  std::optional<SettingInfo> info;  ///< none: there is no such setting
  std::optional<Real> value;        ///< what the scene has, where it is a number; of all muscles that of the first
  std::string objection, remedy;    ///< where there is none
};

/// Looks a setting up in a scene. Precondition: the scene has a method.
SettingLookup look_up_setting(const Scene& scene, const std::string& key);

}  // namespace gracilis
