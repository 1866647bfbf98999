#include <gracilis/opensim/reader/model_reader.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/opensim/reader/body_reader.hpp>
#include <gracilis/opensim/reader/constraint_reader.hpp>
#include <gracilis/opensim/reader/force_reader.hpp>
#include <gracilis/opensim/reader/joint_reader.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace gracilis::opensim {

static constexpr int newest_version = 40600;

template <class T>
static std::vector<std::string> names(const std::vector<T>& things) {
  std::vector<std::string> result;
  for (const T& thing : things) result.push_back(thing.name);
  return result;
}

/// Without "NAME/..": OpenSim's paths may go up and down. What ends in ".." names what holds the element: its owner.
static std::string plain_reference(const std::string& reference, const std::string& owner) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= reference.size();) {
    const std::size_t end = std::min(reference.find('/', begin), reference.size());
    const std::string part = reference.substr(begin, end - begin);
    begin = end + 1;
    if (part == ".." && !parts.empty() && parts.back() != "..")
      parts.pop_back();
    else if (part != "." && !part.empty())
      parts.push_back(part);
  }
  if (parts.empty() || parts.back() == "..") return parts.empty() && !reference.starts_with("..") ? reference : owner;
  std::string plain = reference.starts_with('/') ? "/" : "";
  for (std::size_t i = 0; i < parts.size(); ++i) plain += (i > 0 ? "/" : "") + parts[i];
  return plain;
}

PlacedFrame ModelReading::frame(const pugi::xml_node& node, const std::string& given, const std::string& owner) const {
  const std::string reference = given.find("..") == std::string::npos ? given : plain_reference(given, owner);
  // Some bodies have a name that begins with a slash.
  if (const Index body = index_of(model.bodies, reference); body >= 0) return {body, RigidTransform::Identity()};
  const std::string name = last_name(reference);
  const std::string above = reference.substr(0, reference.size() - name.size());
  if (above.size() > 1)
    if (const auto found = model.frames.find(last_name(above.substr(0, above.size() - 1)) + "/" + name);
        found != model.frames.end())
      return found->second;
  if (const auto found = model.frames.find(owner + "/" + name); found != model.frames.end()) return found->second;
  if (const Index body = index_of(model.bodies, name); body >= 0) return {body, RigidTransform::Identity()};
  for (const auto& [key, placed] : model.frames)
    if (last_name(key) == name) return placed;
  context.fail(node, fmt::format("names the body '{}', which does not exist", reference),
               suggestion(name, names(model.bodies)));
}

bool ModelReading::knows_frame(const pugi::xml_node& node, const std::string& reference) const {
  try {
    frame(node, reference, "");
    return true;
  } catch (const InputError&) {
    return false;
  }
}

Index ModelReading::coordinate(const pugi::xml_node& node, const std::string& reference) const {
  const Index index = index_of(model.coordinates, last_name(reference));
  if (index < 0)
    context.fail(node, fmt::format("names the coordinate '{}', which does not exist", reference),
                 suggestion(last_name(reference), names(model.coordinates)));
  return index;
}

void ModelReading::leave_out(const pugi::xml_node& node, const std::string& what) {
  std::string line = fmt::format("{} '{}': {}", node.name(), name_of(node), what);
  if (told.insert(line).second) model.unsupported.push_back(std::move(line));
}

/// Sets of a model that stand beside bodies, joints, constraints and forces. What is in them takes no part.
static void list_others(ModelReading& reading, const pugi::xml_node& model) {
  for (const char* set : {"ControllerSet", "ContactGeometrySet", "ComponentSet", "ProbeSet", "components"})
    for (const pugi::xml_node& node : objects_of(model, set))
      if (std::string_view(node.name()) != "PhysicalOffsetFrame") reading.leave_out(node, "left out");
}

Model read_model(const std::filesystem::path& path) {
  const XmlFile file = read_xml(path);
  const pugi::xml_node root = file.root.child("Model");
  if (!root) throw InputError({path.string(), "", "holds no model", "is it an .osim file?"});
  Model model;
  model.name = name_of(root);
  if (model.name.empty()) model.name = path.stem().string();
  model.version = file.version;
  if (model.version < 30000)
    model.unsupported.push_back(fmt::format("document version {}, read as one of OpenSim 3", model.version));
  if (model.version > newest_version)
    model.unsupported.push_back(fmt::format("document version {}; {} (OpenSim 4.6) is the newest that is known",
                                            model.version, newest_version));
  ModelReading reading{{path, root.child("defaults"), file.version}, model};
  model.gravity = reading.context.vector(root, "gravity", model.gravity);
  read_bodies(reading, root);
  read_joints(reading, root);
  read_constraints(reading, root);
  read_forces(reading, root, "ForceSet");
  list_others(reading, root);
  return model;
}

void read_force_set(const std::filesystem::path& path, bool replace, Model& model) {
  const XmlFile file = read_xml(path);
  const pugi::xml_node set = file.root.child("ForceSet");
  if (!set) throw InputError({path.string(), "", "holds no force set", "name a file with actuators"});
  if (replace) {
    model.muscles.clear();
    model.actuators.clear();
    model.passive_forces.clear();
    model.missing_forces.clear();
  }
  ModelReading reading{{path, set.child("defaults"), file.version}, model};
  read_forces(reading, file.root, "ForceSet");
}

}  // namespace gracilis::opensim
