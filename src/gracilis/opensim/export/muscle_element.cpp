#include <gracilis/opensim/export/muscle_element.hpp>

#include <gracilis/opensim/export/muscle_text.hpp>

#include <fmt/format.h>

#include <sstream>
#include <string_view>

namespace gracilis::opensim {

pugi::xml_node geometry_path_of(const pugi::xml_node& force) {
  const pugi::xml_node path = force.child("GeometryPath");
  return path ? path : force.child("path").child("GeometryPath");
}

/// The last of this name, which is the one that is read.
static pugi::xml_node element_of(const XmlFile& file, const std::string& muscle) {
  pugi::xml_node found;
  for (const pugi::xml_node& force : objects_of(file.root.child("Model"), "ForceSet"))
    if (name_of(force) == muscle) found = force;
  return found;
}

/// The element in a document of its own, with the properties that it leaves to <defaults>.
static pugi::xml_document whole_element(const XmlFile& file, const std::string& muscle) {
  const pugi::xml_node own = element_of(file, muscle);
  pugi::xml_document document;
  pugi::xml_node element = document.append_copy(own);
  for (const pugi::xml_node& property : file.root.child("Model").child("defaults").child(own.name()).children())
    if (!element.child(property.name()) && std::string_view(property.name()) != "GeometryPath")
      element.append_copy(property);
  return document;
}

static std::string text_of(const pugi::xml_document& document) {
  std::ostringstream text;
  document.document_element().print(text, "  ", pugi::format_default, pugi::encoding_utf8, 3);
  return text.str();
}

std::string own_muscle_text(const XmlFile& file, const std::string& muscle) {
  return text_of(whole_element(file, muscle));
}

std::string own_muscle_text_along(const XmlFile& file, const Model& model, const Muscle& muscle) {
  pugi::xml_document document = whole_element(file, muscle.name), points;
  pugi::xml_node element = document.document_element(), path = geometry_path_of(element);
  points.load_string(point_set_text(model, muscle.path).c_str());
  path.remove_child("PathPointSet");
  path.remove_child("PathWrapSet");
  path.append_copy(points.document_element());
  element.remove_child("tendon_slack_length");
  element.append_child("tendon_slack_length").text().set(fmt::format("{}", muscle.tendon_slack_length).c_str());
  return text_of(document);
}

}  // namespace gracilis::opensim
