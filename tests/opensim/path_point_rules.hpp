#pragma once

#include "opensim/function_set_rules.hpp"

#include <array>

/// The rules by which OpenSim takes path points of a force set, from its sources (PathPoint.cpp, MovingPathPoint.cpp,
/// SimmSpline.cpp, GeometryPath.cpp, version 4.6). Nothing of our own reader is used.
namespace gracilis::opensim {

/// Whether an element holds one function that OpenSim can make: a number, or a spline through rising places.
inline bool is_point_function(const pugi::xml_node& location) {
  const pugi::xml_node function = location.first_child();
  if (function.next_sibling()) return false;
  if (std::string(function.name()) == "Constant") return words_in(function.child_value("value")).size() == 1;
  const std::vector<std::string> x = words_in(function.child_value("x")), y = words_in(function.child_value("y"));
  for (std::size_t i = 1; i < x.size(); ++i)
    if (!(std::stod(x[i]) > std::stod(x[i - 1]))) return false;
  return std::string(function.name()) == "SimmSpline" && x.size() >= 2 && x.size() == y.size();
}

/// What OpenSim would throw about, or read otherwise than it was meant, in a set of version 4.0 or later, a sentence
/// each. `components`: absolute paths of the model's bodies and coordinates.
inline std::vector<std::string> broken_point_rules(const std::string& file, const std::set<std::string>& components) {
  std::vector<std::string> broken;
  const auto require = [&](bool holds, const std::string& what) {
    if (!holds) broken.push_back(what);
  };
  pugi::xml_document document;
  require(static_cast<bool>(document.load_string(file.c_str())), "is XML");
  const pugi::xml_node root = document.child("OpenSimDocument");
  require(root.attribute("Version").as_int() >= 40000, "sockets came with 4.0");
  std::set<std::string> names;
  for (const pugi::xml_node& force : root.child("ForceSet").child("objects").children()) {
    const std::string name = force.attribute("name").as_string();
    require(names.insert(name).second, name + " occurs once");
    int count = 0;
    for (const pugi::xml_node& point : force.child("GeometryPath").child("PathPointSet").child("objects").children()) {
      const std::string where = name + ", " + point.attribute("name").as_string();
      ++count;
      require(components.count(point.child_value("socket_parent_frame")) > 0, where + " lies on a body");
      if (std::string(point.name()) != "MovingPathPoint") {
        require(words_in(point.child_value("location")).size() == 3, where + " has a place");
        continue;
      }
      std::array<std::string, 3> coordinates;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::string axis(1, "xyz"[i]);
        coordinates[i] = point.child_value(("socket_" + axis + "_coordinate").c_str());
        require(components.count(coordinates[i]) > 0, where + " moves with a coordinate in " + axis);
        require(is_point_function(point.child((axis + "_location").c_str())), where + " has a function in " + axis);
      }
      // MovingPathPoint::extendConnectToModel
      require(coordinates[0] == coordinates[1] && coordinates[0] == coordinates[2],
              where + " moves with one coordinate");
    }
    require(count >= 2, name + " has two points");
  }
  require(!names.empty(), "holds forces");
  return broken;
}

}  // namespace gracilis::opensim
