#pragma once

#include "io/test_files.hpp"

#include <gracilis/opensim/reader/model_reader.hpp>

#include <string>

/// Small models written as OpenSim writes them.
namespace gracilis::opensim {

inline std::string document(const std::string& model, const std::string& version = "40000") {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n<OpenSimDocument Version=\"" + version +
         "\"><Model name=\"tiny\">" + model + "</Model></OpenSimDocument>";
}

inline std::string body(const std::string& name, const std::string& more = "") {
  return "<Body name=\"" + name +
         "\"><mass>2</mass><mass_center>0 -0.5 0</mass_center><inertia>0.1 0.1 0.1 0 0 0</inertia>" + more + "</Body>";
}

/// A joint of 4.x between frames that lie at `place` of the parent and at the child's origin.
inline std::string joint(const std::string& type, const std::string& name, const std::string& parent,
                         const std::string& child, const std::string& coordinates, const std::string& more = "",
                         const std::string& place = "0 0 0", const std::string& turned = "0 0 0") {
  return "<" + type + " name=\"" + name + "\"><socket_parent_frame>from</socket_parent_frame>" +
         "<socket_child_frame>to</socket_child_frame><coordinates>" + coordinates + "</coordinates><frames>" +
         "<PhysicalOffsetFrame name=\"from\"><socket_parent>" + parent + "</socket_parent><translation>" + place +
         "</translation><orientation>" + turned + "</orientation></PhysicalOffsetFrame>" +
         "<PhysicalOffsetFrame name=\"to\"><socket_parent>/bodyset/" + child +
         "</socket_parent></PhysicalOffsetFrame></frames>" + more + "</" + type + ">";
}

inline std::string coordinate(const std::string& name, const std::string& value = "0") {
  return "<Coordinate name=\"" + name + "\"><default_value>" + value + "</default_value></Coordinate>";
}

inline std::string set(const std::string& name, const std::string& objects) {
  return "<" + name + "><objects>" + objects + "</objects></" + name + ">";
}

inline std::string point(const std::string& body, const std::string& place) {
  return "<PathPoint name=\"p\"><socket_parent_frame>" + body + "</socket_parent_frame><location>" + place +
         "</location></PathPoint>";
}

inline std::string muscle(const std::string& name, const std::string& points, const std::string& more = "",
                          const std::string& wraps = "") {
  return "<Thelen2003Muscle name=\"" + name + "\"><GeometryPath>" + set("PathPointSet", points) +
         set("PathWrapSet", wraps) + "</GeometryPath>" + more + "</Thelen2003Muscle>";
}

/// A pendulum: a rod of 2 kg, turning about z at the ground's origin, its mass 0.5 m below.
inline std::string pendulum(const std::string& forces = "", const std::string& body_more = "") {
  return document(set("BodySet", body("rod", body_more)) +
                  set("JointSet", joint("PinJoint", "hinge", "/ground", "rod", coordinate("swing"))) +
                  set("ForceSet", forces));
}

inline Model model_from(const std::string& text, const std::string& name = "model.osim") {
  const TestFolder folder;
  return read_model(folder.write(name, text));
}

inline std::string complaint_about(const std::string& text) {
  return message_of_input_error([&] { model_from(text); });
}

}  // namespace gracilis::opensim
