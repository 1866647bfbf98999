#include <gracilis/opensim/export/model_with_paths.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/opensim/export/muscle_text.hpp>
#include <gracilis/opensim/reader/xml.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <sstream>

namespace gracilis::opensim {

/// From that of a child of 4.x to what 3.x calls it, with the name alone instead of a component's path.
static void rename_child(pugi::xml_node node, const char* name, const char* old_name) {
  pugi::xml_node child = node.child(name);
  if (!child) return;
  child.set_name(old_name);
  child.text().set(last_name(child.text().get()).c_str());
}

static void write_as_version_3(pugi::xml_node points) {
  for (pugi::xml_node point : points.child("objects").children()) {
    rename_child(point, "socket_parent_frame", "body");
    for (const std::string axis : {"x", "y", "z"})
      rename_child(point, ("socket_" + axis + "_coordinate").c_str(), (axis + "_coordinate").c_str());
  }
}

namespace {

/// A part of the file's text and what stands there instead.
struct Edit {
  std::size_t begin, end;
  std::string text;
};

}  // namespace

/// Where an element begins in the text that it was read from.
static std::size_t begin_of(const pugi::xml_node& node) { return static_cast<std::size_t>(node.offset_debug()) - 1; }

/// Where it ends. Elements of one name do not lie in each other.
static std::size_t end_of(const pugi::xml_node& node, const std::string& text) {
  const std::size_t opened = text.find('>', begin_of(node));
  if (text[opened - 1] == '/') return opened + 1;
  const std::string close = fmt::format("</{}>", node.name());
  return text.find(close, opened) + close.size();
}

static void replace_path(const pugi::xml_node& force, const Model& model, const Muscle& muscle, const std::string& text,
                         std::vector<Edit>& edits) {
  pugi::xml_document written;
  written.load_string(muscle_text(model, muscle).c_str());
  const pugi::xml_node points = written.document_element().child("GeometryPath").child("PathPointSet");
  if (model.version < 40000) write_as_version_3(points);
  std::ostringstream points_text;
  points.print(points_text, "", pugi::format_raw);
  const pugi::xml_node path = force.child("GeometryPath"), own = path.child("PathPointSet");
  edits.push_back({begin_of(own), end_of(own, text), points_text.str()});
  if (const pugi::xml_node wraps = path.child("PathWrapSet"))
    edits.push_back({begin_of(wraps), end_of(wraps, text), ""});
  const std::string slack = fmt::format("<tendon_slack_length>{}</tendon_slack_length>", muscle.tendon_slack_length);
  if (const pugi::xml_node before = force.child("tendon_slack_length"))
    edits.push_back({begin_of(before), end_of(before, text), slack});
  else
    edits.push_back({end_of(path, text), end_of(path, text), slack});
}

std::string model_with_paths(const std::filesystem::path& file, const Model& model,
                             const std::vector<Muscle>& muscles) {
  if (model.version < 30000)
    throw InputError({file.string(), "", fmt::format("is of version {}", model.version),
                      "open it in OpenSim 3 or later and save it"});
  std::string text = read_text(file);
  pugi::xml_document document;
  document.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8);
  std::map<std::string, const Muscle*> replaced;
  for (const Muscle& muscle : muscles) replaced[muscle.name] = &muscle;
  std::vector<Edit> edits;
  const pugi::xml_node in_model = document.child("OpenSimDocument").child("Model");
  for (const pugi::xml_node& force : objects_of(in_model, "ForceSet"))
    if (const auto found = replaced.find(name_of(force)); found != replaced.end())
      replace_path(force, model, *found->second, text, edits);
  // From the last on, so that places before stay.
  std::sort(edits.begin(), edits.end(), [](const Edit& a, const Edit& b) { return a.begin > b.begin; });
  for (const Edit& edit : edits) text.replace(edit.begin, edit.end - edit.begin, edit.text);
  return text;
}

}  // namespace gracilis::opensim
