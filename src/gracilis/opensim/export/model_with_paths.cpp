#include <gracilis/opensim/export/model_with_paths.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/text_cells.hpp>
#include <gracilis/opensim/export/muscle_element.hpp>
#include <gracilis/opensim/export/muscle_text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

namespace gracilis::opensim {

namespace {

/// A part of the file's text and what stands there instead.
struct Edit {
  std::size_t begin, end;
  std::string text;
};

}  // namespace

/// Where an element begins in the text that it was read from.
static std::size_t begin_of(const pugi::xml_node& node) { return static_cast<std::size_t>(node.offset_debug()) - 1; }

static std::size_t behind(const std::string& text, std::string_view mark, std::size_t from) {
  const std::size_t found = text.find(mark, from);
  return found == std::string::npos ? text.size() : found + mark.size();
}

/// Behind the tag, comment or section that begins here. Attributes may hold a '>'.
static std::size_t behind_markup(const std::string& text, std::size_t begin) {
  for (const auto& [open, close] :
       {std::pair<std::string_view, std::string_view>{"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}})
    if (text.compare(begin, open.size(), open) == 0) return behind(text, close, begin + open.size());
  std::size_t at = text.find_first_of(">\"'", begin);
  while (at < text.size() && text[at] != '>')
    at = text.find_first_of(">\"'", behind(text, std::string_view(&text[at], 1), at + 1));
  return std::min(at, text.size() - 1) + 1;
}

/// Where it ends: where as many tags have been closed as opened. The parser does not keep that place.
static std::size_t end_of(const pugi::xml_node& node, const std::string& text) {
  std::size_t open = 0;
  for (std::size_t begin = begin_of(node); begin < text.size();) {
    const std::size_t end = behind_markup(text, begin);
    const char first = text[begin + 1];
    if (first == '/')
      --open;
    else if (first != '!' && first != '?' && text[end - 2] != '/')
      ++open;
    if (open == 0) return end;
    begin = text.find('<', end);
  }
  return text.size();
}

static void replace_path(const std::filesystem::path& file, const pugi::xml_node& force, const Model& model,
                         const Muscle& muscle, const std::string& text, std::vector<Edit>& edits) {
  const pugi::xml_node path = geometry_path_of(force), own = path.child("PathPointSet");
  if (!own)
    throw InputError({file.string(), fmt::format("{} '{}'", force.name(), muscle.name),
                      "has no GeometryPath with points that others could take the place of",
                      "give it one, or leave the muscle out of the scene"});
  const std::string points = point_set_text(model, muscle.path);
  edits.push_back({begin_of(own), end_of(own, text), std::string(trimmed(points))});
  if (const pugi::xml_node wraps = path.child("PathWrapSet"))
    edits.push_back({begin_of(wraps), end_of(wraps, text), ""});
  const std::string slack = fmt::format("<tendon_slack_length>{}</tendon_slack_length>", muscle.tendon_slack_length);
  if (const pugi::xml_node before = force.child("tendon_slack_length")) {
    edits.push_back({begin_of(before), end_of(before, text), slack});
  } else {
    const std::size_t place = begin_of(path.parent() == force ? path : path.parent());
    edits.push_back({place, place, slack});
  }
}

std::string model_with_paths(const std::filesystem::path& file, const Model& model,
                             const std::vector<Muscle>& muscles) {
  if (model.version < 30000)
    throw InputError({file.string(), "", fmt::format("is of version {}", model.version),
                      "open it in OpenSim 3 or later and save it"});
  std::string text = read_text(file);
  pugi::xml_document document;
  if (!document.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8))
    throw InputError({file.string(), "", "is not XML", "save it again with OpenSim"});
  std::map<std::string, const Muscle*> replaced;
  for (const Muscle& muscle : muscles) replaced[muscle.name] = &muscle;
  std::vector<Edit> edits;
  const pugi::xml_node in_model = document.child("OpenSimDocument").child("Model");
  for (const pugi::xml_node& force : objects_of(in_model, "ForceSet"))
    if (const auto found = replaced.find(name_of(force)); found != replaced.end())
      replace_path(file, force, model, *found->second, text, edits);
  // From the last on, so that places before stay.
  std::sort(edits.begin(), edits.end(), [](const Edit& a, const Edit& b) { return a.begin > b.begin; });
  for (const Edit& edit : edits) text.replace(edit.begin, edit.end - edit.begin, edit.text);
  return text;
}

}  // namespace gracilis::opensim
