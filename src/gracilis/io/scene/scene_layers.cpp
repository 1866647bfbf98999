#include <gracilis/io/scene/scene_layers.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/parse_toml.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/io/toml_reader.hpp>

#include <algorithm>
#include <unordered_map>

namespace gracilis {

namespace fs = std::filesystem;

static void insert_moved(toml::table& table, const toml::key& key, toml::node& node) {
  table.erase(key.str());
  // Moving keeps the place that the node came from; copying loses it.
  node.visit([&](auto& value) { table.insert(key, std::move(value)); });
}

static std::string name_of(const toml::node& element) {
  const toml::table* table = element.as_table();
  return table ? (*table)["name"].value_or(std::string()) : std::string();
}

static bool is_named_list(const toml::node& node) {
  const toml::array* array = node.as_array();
  return array && std::all_of(array->begin(), array->end(), [](const toml::node& e) { return !name_of(e).empty(); });
}

static void lay_over(toml::table& lower, toml::table& upper);

static void lay_list_over(toml::array& lower, toml::array& upper) {
  std::unordered_map<std::string, std::size_t> places;  // of the first element of each name
  for (std::size_t i = 0; i < lower.size(); ++i) places.emplace(name_of(lower[i]), i);
  for (toml::node& element : upper) {
    const auto [same, is_new] = places.emplace(name_of(element), lower.size());
    if (is_new) {
      lower.push_back(std::move(*element.as_table()));
    } else {
      lay_over(*lower[same->second].as_table(), *element.as_table());
    }
  }
}

static void lay_over(toml::table& lower, toml::table& upper) {
  for (auto&& [key, node] : upper) {
    toml::node* below = lower.get(key.str());
    if (below && below->is_table() && node.is_table() && key.str() != "motion") {
      lay_over(*below->as_table(), *node.as_table());
    } else if (below && is_named_list(*below) && is_named_list(node)) {
      lay_list_over(*below->as_array(), *node.as_array());
    } else {
      insert_moved(lower, key, node);
    }
  }
}

static bool erase_settings(toml::table& table) {
  bool erased = table.erase("settings");
  erased |= table.erase("distance_field");
  erased |= table.erase("contact");
  if (toml::array* muscles = table["muscles"].as_array()) {
    for (toml::node& muscle : *muscles) {
      if (toml::table* entries = muscle.as_table()) erased |= entries->erase("settings");
    }
  }
  return erased;
}

static void add_layer(SceneLayers& layers, toml::table& upper) {
  const std::string preset = upper["preset"].value_or(std::string());
  if (!preset.empty() && layers.table["preset"].value_or(std::string("physical")) != preset) {
    layers.table.erase("method");  // the preset brings its own
    if (erase_settings(layers.table))
      layers.notes.push_back("the preset '" + preset + "' sets aside the settings that were chosen for another one");
  }
  lay_over(layers.table, upper);
}

namespace {

// What a person writes stays far below; without limits two lines of text could ask for days and all memory.
constexpr std::size_t deepest_include = 32, most_files = 256, most_bytes = 64 << 20;

/// Files that are being read, from the first to the one that includes the next, and what was read in all.
struct Including {
  std::vector<fs::path> open;
  std::size_t files = 0, bytes = 0;

  void require_limits(const fs::path& path) const {
    const auto refuse = [&](const std::string& what) {
      throw ConfigurationError({path.string(), "", what, "include fewer files"});
    };
    if (open.size() > deepest_include)
      refuse("is included by way of more than " + std::to_string(deepest_include) + " files");
    if (files > most_files) refuse("the scene includes more than " + std::to_string(most_files) + " files");
    if (bytes > most_bytes) refuse("the scene's files have more than " + std::to_string(most_bytes >> 20) + " MiB");
  }
};

}  // namespace

/// The file's own table with those it includes below it.
static void add_file(SceneLayers& layers, const fs::path& path, Including& including) {
  std::vector<fs::path>& open = including.open;
  std::error_code error;
  fs::path canonical = fs::weakly_canonical(path, error);
  if (error) canonical = path;  // reading it says what is wrong
  if (std::find(open.begin(), open.end(), canonical) != open.end()) {
    throw ConfigurationError({path.string(), "", "includes itself, by way of '" + open.back().string() + "'", ""});
  }
  open.push_back(canonical);
  require_readable_file(path);
  ++including.files;
  including.bytes += fs::file_size(path, error);
  including.require_limits(path);
  toml::table table = parse_written_toml(read_text(path), path.string());
  if (std::find(layers.files.begin(), layers.files.end(), path) == layers.files.end()) layers.files.push_back(path);

  std::vector<Problem> problems;
  const std::vector<std::string> included = TomlReader(table, "the scene file", problems).texts("include");
  if (!problems.empty()) throw ConfigurationError(problems);
  table.erase("include");
  for (const std::string& file : included) add_file(layers, path.parent_path() / file, including);
  add_layer(layers, table);
  open.pop_back();
}

/// A value from the command line; a bare word is a text.
static toml::table parse_value(const std::string& value, const std::string& source) {
  const bool word = !value.empty() && std::all_of(value.begin(), value.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-' || c == '.';
  });
  try {
    return parse_toml("value = " + value, source);
  } catch (const toml::parse_error&) {
    if (word) return parse_toml("value = \"" + value + "\"", source);
    throw ConfigurationError({source, "", "the value cannot be read",
                              "write a number, true, false, a word, or three numbers as [0, 0, -9.81]"});
  }
}

static std::vector<std::string> muscle_names(toml::table& table) {
  std::vector<std::string> names;
  if (const toml::array* muscles = table["muscles"].as_array()) {
    for (const toml::node& muscle : *muscles) names.push_back(name_of(muscle));
  }
  return names;
}

/// key=value as a layer of its own.
static toml::table layer_of(const std::string& setting, const std::vector<std::string>& muscles) {
  const std::string source = "--set " + setting;
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw ConfigurationError({source, "", "is not of the form key=value", "for example --set iterations=50"});
  }
  std::string key = setting.substr(0, equals);
  toml::table value = parse_value(setting.substr(equals + 1), source);
  toml::table layer;
  if (key == "preset" || key == "method") {
    insert_moved(layer, toml::key(key), *value.get("value"));
    return layer;
  }

  if (const std::string meant = nearest_word(key, {"method", "preset"}); !meant.empty())
    throw ConfigurationError({source, "", "unknown key '" + shortened(key) + "'", "did you mean '" + meant + "'?"});
  const std::size_t dot = key.rfind('.');
  const std::string owner = dot == std::string::npos ? "settings" : key.substr(0, dot);
  if (dot != std::string::npos) key = key.substr(dot + 1);
  toml::table entries;
  insert_moved(entries, toml::key(key), *value.get("value"));
  if (owner == "motion" || is_setting_section(owner)) {
    layer.insert(owner, std::move(entries));
    return layer;
  }
  if (std::find(muscles.begin(), muscles.end(), owner) == muscles.end()) {
    std::vector<std::string> owners = muscles;
    owners.insert(owners.end(), setting_sections.begin(), setting_sections.end());
    owners.emplace_back("motion");
    throw ConfigurationError({source, "", "the scene has no muscle '" + owner + "'", suggestion(owner, owners)});
  }
  toml::table muscle;
  muscle.insert("name", owner);
  muscle.insert("settings", std::move(entries));
  toml::array list;
  list.push_back(std::move(muscle));
  layer.insert("muscles", std::move(list));
  return layer;
}

/// Lays `set` over the layers. The preset comes first: it sets aside what lies below it, but nothing that the command
/// line says itself.
static void add_command_line(SceneLayers& layers, std::vector<std::string> set,
                             const std::vector<std::string>& muscles) {
  std::stable_partition(set.begin(), set.end(), [](const std::string& s) { return s.starts_with("preset="); });
  std::vector<Problem> problems;
  for (const std::string& setting : set) {
    try {
      toml::table layer = layer_of(setting, muscles);
      toml::table* motion = layers.table["motion"].as_table();
      // A file that gives a motion gives all of it; the command line changes one key.
      if (motion && layer.contains("motion")) {
        lay_over(*motion, *layer["motion"].as_table());
      } else {
        add_layer(layers, layer);
      }
    } catch (const ConfigurationError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  if (!problems.empty()) throw ConfigurationError(problems);
}

SceneLayers command_line_layers(const std::vector<std::string>& set, const std::vector<std::string>& muscles) {
  SceneLayers layers;
  add_command_line(layers, set, muscles);
  return layers;
}

SceneLayers load_scene_layers(const fs::path& path, const std::vector<std::string>& set) {
  SceneLayers layers;
  Including including;
  add_file(layers, path, including);
  const std::vector<std::string> muscles = muscle_names(layers.table);
  add_command_line(layers, set, muscles);
  return layers;
}

}  // namespace gracilis
