#pragma once

#include <gracilis/opensim/import/bone_files.hpp>
#include <gracilis/opensim/import/muscle_volume.hpp>
#include <gracilis/opensim/kinematics/coordinate_motion.hpp>

namespace gracilis::opensim {

/// A motion for the scene: its name becomes that of its files.
struct NamedMotion {
  std::string name;
  CoordinateMotion motion;
};

struct SceneFolderSettings {
  VolumeSettings volumes;
  std::vector<std::string> muscles;  ///< to take; empty: all
  bool apart = false;                ///< muscles whose surfaces are not known keep out of each other
  bool merge_heads = false;          ///< heads of one muscle whose surfaces are not known are made one sheet
};

/// What is to be told of a folder that was written, a sentence each.
struct SceneFolderNotes {
  std::vector<std::string> left_out;
  std::vector<std::string> sheets;  ///< muscles made of several heads
};

/// s, between the frames of an imported motion where its rows are closer: marker and force data come with 100 to 1000
/// rows a second, of which a run shows no more than these.
inline constexpr Real imported_time_step = 0.01;

/// How many of a motion's rows a run takes, each `imported_time_step` or more after the last.
int kept_rows(const NamedMotion& motion);

/// What a motion's files are called, without the extension: file_name_of its name, and not "model".
std::string motion_file_name(const NamedMotion& motion);

/// The scene of a motion in the folder of its model.
std::filesystem::path scene_file(const std::filesystem::path& folder, const NamedMotion& motion);

/// Writes a folder that `gracilis run` understands, for the model with its coordinates at their default values:
/// model.toml with bones, joints and muscles, their surfaces under bones/ and muscles/, and for each motion NAME.toml
/// with NAME.sto. Throws InputError.
SceneFolderNotes write_scene_folder(const Model& model, const GeometryPlaces& places,
                                    const std::vector<NamedMotion>& motions, const SceneFolderSettings& settings,
                                    const std::filesystem::path& folder);

}  // namespace gracilis::opensim
