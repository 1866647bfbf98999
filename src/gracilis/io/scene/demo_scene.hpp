#pragma once

#include <gracilis/io/scene/scene_reader.hpp>
#include <gracilis/scene/scene.hpp>

#include <map>
#include <optional>
#include <string>

namespace gracilis {

/// The built-in scene `name`, hip or elbow; its motion flexes from 0 to `flexion` (rad, at least 0) by `step` (rad,
/// more than 0) a frame where they are given, as far and by as much as the scene says otherwise.
Scene demo_scene(const std::string& name, std::optional<Real> flexion = {}, std::optional<Real> step = {});

/// What to make of a built-in scene.
struct DemoOptions {
  std::string scene = "hip", preset = "physical";
  std::string contact;                        ///< how muscles keep out of each other; empty: as the preset says
  std::optional<Real> flexion_deg, step_deg;  ///< as in demo_scene
  std::map<std::string, Real> activations;    ///< by muscle: how active it is where the motion ends, rising from 0
};

/// A built-in scene, changed as `--set` and `--only` say, with what there is to warn about. A muscle that it does not
/// have, or an activation beyond 0 to 1, is a ConfigurationError. Precondition: there is such a preset.
LoadedScene load_demo(const DemoOptions& options, const SceneOptions& changes);

/// The built-in scene that a command means where a scene file may stand: hip for "demo", elbow for "demo-elbow"; none
/// for anything else.
std::optional<std::string> builtin_scene_of(const std::string& word);

/// The scene of a file (read_scene, whose errors it throws), or the built-in one that is meant; `flexion_deg` is for
/// that alone.
LoadedScene load_scene(const std::string& file_or_word, const SceneOptions& options,
                       std::optional<Real> flexion_deg = {});

}  // namespace gracilis
