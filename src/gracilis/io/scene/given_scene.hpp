#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/io/scene/scene_reader.hpp>

#include <toml++/toml.h>

#include <vector>

namespace gracilis {

/// A scene that a program makes: tables with the keys of a scene file. A bone or muscle with the key `given` in the
/// place of `file` has that one of `surfaces` (m), by its number; files that it names are looked for from the working
/// folder on. `options.set` and `options.only` are not asked. Throws as read_scene does.
LoadedScene make_scene(const toml::table& tables, std::vector<TriangleMesh> surfaces, const SceneOptions& options = {});

}  // namespace gracilis
