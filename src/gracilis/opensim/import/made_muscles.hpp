#pragma once

#include <gracilis/opensim/import/scene_folder.hpp>

#include <string>
#include <vector>

namespace gracilis::opensim {

/// A muscle of a model, or several that are heads of one, with a surface.
struct MadeMuscle {
  std::string name;
  MuscleVolume volume;
};

/// The muscles that the settings ask for, in the model's order, a sheet where its first head stands. Those of which no
/// surface can be made are left out, heads that make no sheet stay apart, and `notes` tells both. `volumes` are the
/// settings' with the bones. Throws ConfigurationError where the model lacks a muscle asked for.
std::vector<MadeMuscle> made_muscles(const Model& model, const std::vector<RigidTransform>& poses,
                                     const Eigen::VectorXd& coordinates, const SceneFolderSettings& settings,
                                     VolumeSettings volumes, SceneFolderNotes& notes);

}  // namespace gracilis::opensim
