#pragma once

#include <gracilis/io/scene/scene_in_progress.hpp>
#include <gracilis/io/scene/surfaces.hpp>
#include <gracilis/io/toml_reader.hpp>

#include <string>

/// [[bones]] and [[joints]].
namespace gracilis::sections {

/// One table of [[bones]]; what is wrong with it goes to the reader's problems.
BoneDescription read_bone(TomlReader table);
/// One table of [[joints]], likewise.
JointDescription read_joint(TomlReader table);

/// The index of the body with this name, which is added where there is none yet.
Index body_index(Scene& scene, const std::string& name);

/// Sets the scene's joints, parents before children, and its bodies in their order, the one that no joint moves first.
/// Joints in a circle are a problem.
void place_bodies(SceneInProgress& progress);

/// Adds the next bone with its surface. Precondition: bodies are placed, and it is the next of the description.
void add_bone(SceneInProgress& progress, SurfaceLoader& surfaces, const BoneDescription& description);

}  // namespace gracilis::sections
