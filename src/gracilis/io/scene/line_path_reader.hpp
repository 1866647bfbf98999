#pragma once

#include <gracilis/io/toml_reader.hpp>
#include <gracilis/scene/scene.hpp>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace gracilis {

/// [[muscles.action_line.path]] and [[muscles.action_line.wraps]] as a scene file has them, by names.
struct LinePathDescription {
  LinePath path;  ///< its bodies and coordinates are not set
  std::vector<std::string> point_bodies, wrap_bodies;
  std::vector<std::array<std::string, 4>> coordinates;  ///< of each point: its condition's, and those of x, y, z
};

/// From the table [muscles.action_line].
LinePathDescription read_line_path(TomlReader& line);

/// Sets bodies by `body_index`, coordinates and their capture values from the scene's joints. Precondition: the scene
/// has the coordinates.
LinePath place_line_path(const LinePathDescription& description, const Scene& scene,
                         const std::function<Index(const std::string&)>& body_index);

}  // namespace gracilis
