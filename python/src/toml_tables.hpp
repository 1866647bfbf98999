#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

#include <pybind11/pybind11.h>

#include <toml++/toml.h>

#include <string>
#include <vector>

namespace gracilis::python {

/// What `--set` would say of keywords: a dict under a keyword is a table, as in contact={"muscle": "none"}.
std::vector<std::string> settings_of(const pybind11::dict& keywords);

/// A scene file's tables out of the keywords of gracilis.Scene, and the surfaces that stand in it as arrays.
struct SceneTables {
  toml::table tables;
  std::vector<TriangleMesh> surfaces;
};
SceneTables scene_tables(const pybind11::dict& keywords);

}  // namespace gracilis::python
