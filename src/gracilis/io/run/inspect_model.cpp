#include <gracilis/io/run/inspect_model.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/xml_text.hpp>

#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include <string>

namespace gracilis {

using Json = nlohmann::ordered_json;

/// Elements below <set><objects>; OpenSim keeps its collections this way in all versions.
static pugi::xml_object_range<pugi::xml_node_iterator> objects_of(const pugi::xml_node& model, const char* set) {
  return model.child(set).child("objects").children();
}

static Json names_of(const std::vector<pugi::xml_node>& nodes) {
  Json names = Json::array();
  for (const pugi::xml_node& node : nodes) names.push_back(node.attribute("name").value());
  return names;
}

Json inspect_model(const std::filesystem::path& path) {
  const std::string text = read_text(path);
  pugi::xml_document document;
  parse_xml(path, text, "is not XML", "export the model again", document);
  const pugi::xml_node root = document.child("OpenSimDocument");
  const pugi::xml_node model = root.child("Model");
  if (!model) throw InputError({path.string(), "", "holds no OpenSim model", "is it an .osim file?"});

  std::vector<pugi::xml_node> bodies, joints, coordinates, muscles, other_forces;
  for (const pugi::xml_node& body : objects_of(model, "BodySet")) {
    bodies.push_back(body);
    // Up to version 3 a body holds the joint to its parent.
    for (const pugi::xml_node& joint : body.child("Joint").children()) joints.push_back(joint);
  }
  for (const pugi::xml_node& joint : objects_of(model, "JointSet")) joints.push_back(joint);
  for (const pugi::xml_node& joint : joints) {
    for (const pugi::xml_node& each : joint.child("CoordinateSet").child("objects").children())
      coordinates.push_back(each);
    for (const pugi::xml_node& each : joint.child("coordinates").children()) coordinates.push_back(each);
  }
  for (const pugi::xml_node& force : objects_of(model, "ForceSet")) {
    (force.child("max_isometric_force") ? muscles : other_forces).push_back(force);
  }
  return {{"kind", "OpenSim model"},
          {"name", model.attribute("name").value()},
          {"document_version", root.attribute("Version").value()},
          {"body_count", bodies.size()},
          {"joint_count", joints.size()},
          {"coordinate_count", coordinates.size()},
          {"muscle_count", muscles.size()},
          {"other_force_count", other_forces.size()},
          {"bodies", names_of(bodies)},
          {"coordinates", names_of(coordinates)},
          {"muscles", names_of(muscles)}};
}

}  // namespace gracilis
