#include <gracilis/io/run/inspect.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/run/inspect_data.hpp>
#include <gracilis/io/run/inspect_model.hpp>
#include <gracilis/io/run/inspect_run.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <set>

namespace gracilis {

using Json = nlohmann::ordered_json;

static Json inspect_by_kind(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) return inspect_run(path);
  require_readable_file(path);
  const std::string extension = lower_case_extension(path);
  static const std::set<std::string> surfaces = {".ply", ".stl", ".obj", ".vtk", ".vtp", ".glb"};
  if (surfaces.contains(extension)) return inspect_surface(path);
  if (extension == ".mot" || extension == ".sto") return inspect_table(path);
  if (extension == ".osim") return inspect_model(path);
  if (extension == ".toml") return inspect_scene(path);
  if (extension == ".csv") {
    const std::string text = read_text(path);
    const bool landmarks = text.substr(0, text.find('\n')).find("cloud") != std::string::npos;
    return landmarks ? inspect_landmarks(path) : inspect_table(path);
  }
  throw InputError(
      {path.string(), "", fmt::format("files of kind '{}' are unknown", extension),
       "surfaces: .ply .stl .obj .vtk .vtp .glb; tables: .mot .sto .csv; also .osim, .toml and run folders"});
}

Json inspect_file(const std::filesystem::path& path) {
  Json description = {{"file", path.string()}};
  description.update(inspect_by_kind(path));
  return description;
}

static std::string scalar_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
  return value.is_null() ? "-" : value.dump();
}

/// "1 2 3" for a list of a few numbers, such as a point; empty for anything else.
static std::string numbers_text(const Json& value) {
  std::string text;
  if (!value.is_array() || value.size() > 3) return text;
  for (const Json& item : value) {
    if (!item.is_number()) return "";
    text += (text.empty() ? "" : " ") + scalar_text(item);
  }
  return text;
}

static bool is_plain(const Json& value) { return !value.is_structured(); }

static void append_entry(const std::string& key, const Json& value, const std::string& indent, std::string& text);

static void append_entries(const Json& object, const std::string& indent, std::string& text) {
  for (const auto& [key, value] : object.items()) append_entry(key, value, indent, text);
}

static void append_array(const Json& array, const std::string& indent, std::string& text) {
  for (const Json& item : array) {
    if (!item.is_object()) {
      text += indent + scalar_text(item) + "\n";
      continue;
    }
    // An object in a list takes one line: its first entry is its name.
    std::string line;
    for (const auto& [key, value] : item.items()) {
      const std::string words = line.empty() ? "" : (line.ends_with(": ") ? "" : ", ") + key + " ";
      line += words + (is_plain(value) ? scalar_text(value) : numbers_text(value));
      if (words.empty() && item.size() > 1) line += ": ";
    }
    text += indent + line + "\n";
  }
}

static void append_entry(const std::string& key, const Json& value, const std::string& indent, std::string& text) {
  std::string label = key;
  for (char& c : label) c = c == '_' ? ' ' : c;
  const std::string numbers = numbers_text(value);
  if (is_plain(value)) {
    text += indent + label + ": " + scalar_text(value) + "\n";
  } else if (value.empty()) {
    text += indent + label + ": none\n";
  } else if (!numbers.empty()) {
    text += indent + label + ": " + numbers + "\n";
  } else {
    text += indent + label + ":\n";
    value.is_object() ? append_entries(value, indent + "  ", text) : append_array(value, indent + "  ", text);
  }
}

std::string to_text(const Json& description) {
  std::string text =
      description.at("file").get<std::string>() + ": " + description.at("kind").get<std::string>() + "\n";
  for (const auto& [key, value] : description.items()) {
    if (key != "file" && key != "kind") append_entry(key, value, "  ", text);
  }
  return text;
}

std::string describe_file(const std::filesystem::path& path) { return to_text(inspect_file(path)); }

}  // namespace gracilis
