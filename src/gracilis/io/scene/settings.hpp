#pragma once

#include <gracilis/io/scene/scene_description.hpp>
#include <gracilis/io/toml_reader.hpp>
#include <gracilis/methods/method_entry.hpp>

#include <set>
#include <string>

/// The method, the preset and all tables of settings.
namespace gracilis::sections {

/// What holds for muscles that say nothing else.
struct MuscleDefaults {
  const MethodEntry& method;
  FiberSettings fibers = {};
  ContractionSettings contraction = {};
};

/// Reads what holds for the scene and returns what its muscles start from. Settings that its method does not have are
/// named in `others`.
MuscleDefaults read_settings(TomlReader& top, SceneDescription& description, std::set<std::string>& others);

/// What muscles are solved with together becomes the scene's: the largest value that a muscle asks for.
void share_settings(const MethodEntry& method, SceneDescription& description);

}  // namespace gracilis::sections
