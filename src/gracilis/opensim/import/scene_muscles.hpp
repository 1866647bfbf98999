#pragma once

#include <gracilis/opensim/import/muscle_volume.hpp>

#include <string>
#include <vector>

namespace gracilis::opensim {

/// [[muscles]] as a scene file has it, of a muscle that is called `name` there and in its surface's file. What a scene
/// cannot say of lines is added to `left_out` (scene_lines.hpp).
std::string muscle_text(const Model& model, const std::string& name, const MuscleVolume& volume,
                        const std::vector<RigidTransform>& poses, const Eigen::VectorXd& coordinates,
                        const VolumeSettings& settings, std::vector<std::string>& left_out);

}  // namespace gracilis::opensim
