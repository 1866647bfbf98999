#include "completion_names.hpp"

#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/run/recorded_run.hpp>
#include <gracilis/io/scene/demo_scene.hpp>
#include <gracilis/io/scene/scene_layers.hpp>
#include <gracilis/io/scene/scene_template.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/opensim/reader/model_reader.hpp>

#include <gracilis/scene/setting_values.hpp>

#include <algorithm>
#include <filesystem>

namespace gracilis {

namespace {

namespace fs = std::filesystem;

SubjectNames names_in_scene(const Scene& scene) {
  SubjectNames names;
  for (const Muscle& muscle : scene.muscles) names.muscles.push_back(muscle.name);
  for (const Bone& bone : scene.bones) names.bones.push_back(bone.name);
  for (const Joint& joint : scene.joints) names.joints.push_back(joint.name);
  names.coordinates = coordinate_names(scene);
  names.method = scene.method.name;
  return names;
}

/// The texts under a key of the tables in an array.
void collect(const toml::node_view<const toml::node>& array, const char* key, std::vector<std::string>& names) {
  if (const toml::array* tables = array.as_array())
    for (const toml::node& each : *tables)
      if (const toml::table* table = each.as_table())
        if (const std::optional<std::string> name = (*table)[key].value<std::string>()) names.push_back(*name);
}

/// Of the file and what it includes; no surface is read.
SubjectNames names_in_scene_file(const fs::path& file) {
  const SceneLayers layers = load_scene_layers(file, {});
  const toml::table& scene = layers.table;
  SubjectNames names;
  collect(toml::node_view<const toml::node>(scene["muscles"]), "name", names.muscles);
  collect(toml::node_view<const toml::node>(scene["bones"]), "name", names.bones);
  collect(toml::node_view<const toml::node>(scene["joints"]), "name", names.joints);
  if (const toml::array* joints = scene["joints"].as_array())
    for (const toml::node& joint : *joints)
      if (const toml::table* table = joint.as_table())
        collect(toml::node_view<const toml::node>((*table)["axes"]), "coordinate", names.coordinates);
  names.method = scene["method"].value_or(std::string());
  if (const std::optional<Preset> preset = find_preset(scene["preset"].value_or(std::string("")));
      preset && names.method.empty())
    names.method = preset->method.name;
  return names;
}

SubjectNames names_in_model(const fs::path& file) {
  const opensim::Model model = opensim::read_model(file);
  SubjectNames names;
  names.muscles = opensim::names_of(model.muscles);
  names.bones = opensim::names_of(model.bodies);
  names.joints = opensim::names_of(model.joints);
  names.coordinates = opensim::names_of(model.coordinates);
  return names;
}

void add_keys(const std::string& begin, const std::vector<DescribedSetting>& settings, std::vector<Candidate>& all) {
  for (const DescribedSetting& setting : settings)
    all.push_back({begin + std::string(setting.key) + "=",
                   "default " + to_text(setting.default_value) + ": " + std::string(setting.meaning)});
}

/// The values that a key may have: its choices, or its default to begin with.
void add_values(const std::string& begin, const std::vector<DescribedSetting>& settings, const std::string& key,
                std::vector<Candidate>& all) {
  for (const DescribedSetting& setting : settings) {
    if (begin + std::string(setting.key) != key) continue;
    if (setting.kind == SettingKind::flag)
      for (const char* value : {"true", "false"}) all.push_back({key + "=" + value, ""});
    for (const std::string_view choice : setting.choices) all.push_back({key + "=" + std::string(choice), ""});
    if (setting.kind == SettingKind::integer || setting.kind == SettingKind::number)
      all.push_back({key + "=" + to_text(setting.default_value), "the default; " + expectation(setting)});
  }
}

struct SettingGroup {
  std::string begin;
  std::vector<DescribedSetting> settings;
};

std::vector<SettingGroup> setting_groups(const SubjectNames& names) {
  const MethodEntry* found = find_method(names.method);
  const MethodEntry& method = found ? *found : methods().front();
  std::vector<SettingGroup> groups = {{"", method.settings},
                                      {"contact.", method.contact},
                                      {"sequence.", describe_settings<Sequence>()},
                                      {"distance_field.", describe_settings<DistanceFieldSettings>()},
                                      {"fibers.", describe_settings<FiberSettings>()},
                                      {"contraction.", describe_settings<ContractionSettings>()},
                                      {"prepare.", describe_settings<PrepareSettings>()}};
  for (const std::string& muscle : names.muscles) {
    std::vector<DescribedSetting> own;
    for (const DescribedSetting& setting : method.settings)
      if (!setting.is_shared) own.push_back(setting);
    groups.push_back({muscle + ".", own});
  }
  return groups;
}

const std::vector<std::string>& surface_endings() {
  static const std::vector<std::string> endings = {".ply", ".stl", ".obj", ".vtk", ".vtp", ".glb"};
  return endings;
}

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)); }

/// ".mot" and ".sto" of "Motion to make a scene for (.mot, .sto)".
std::vector<std::string> endings_in(const std::string& description) {
  std::vector<std::string> endings;
  for (std::size_t i = 0; i < description.size(); ++i) {
    if (description[i] != '.' || (i > 0 && (is_word(description[i - 1]) || description[i - 1] == '.'))) continue;
    std::size_t end = i + 1;
    while (end < description.size() && is_word(description[end])) ++end;
    if (end - i >= 4) endings.push_back(description.substr(i, end - i));
  }
  const auto says = [&](const char* words) { return description.find(words) != std::string::npos; };
  if (says("TOML") || says("cene file")) endings.push_back(".toml");
  if (says("OpenSim model")) endings.push_back(".osim");
  if (says("Surfaces") && !says("Folder"))
    endings.insert(endings.end(), surface_endings().begin(), surface_endings().end());
  return endings;
}

/// "~/x" as the shell has it.
fs::path expanded(const std::string& text) {
  const char* home = std::getenv("HOME");
  return home && text.starts_with("~/") ? fs::path(home + text.substr(1)) : fs::path(text);
}

}  // namespace

SubjectNames names_in_subject(const std::vector<std::string>& words) try {
  const bool of_demo = words.size() > 1 && words[1] == "demo";
  for (std::size_t i = 2; i + 1 < words.size(); ++i) {
    if (words[i] == "demo-elbow" || (of_demo && words[i] == "elbow")) return names_in_scene(demo_scene("elbow"));
    if (words[i] == "demo") return names_in_scene(demo_scene("hip"));
    const fs::path path = expanded(words[i]);
    if (path.extension() == ".toml" && is_there(path)) return names_in_scene_file(path);
    if (path.extension() == ".osim" && is_there(path)) return names_in_model(path);
    if (is_there(path / "run.json")) {
      const RecordedRun run = open_recorded_run(path);
      SubjectNames names{run.muscles, run.bones, {}, {}, {}};
      for (const std::string& column : run.coordinates) names.coordinates.push_back(coordinate_label(column).name);
      return names;
    }
  }
  return of_demo ? names_in_scene(demo_scene("hip")) : SubjectNames{};
} catch (const std::exception&) {
  return {};
}

std::vector<Candidate> setting_candidates(const SubjectNames& names, const std::string& begun) {
  std::vector<Candidate> all;
  const std::string key = begun.substr(0, begun.find('='));
  if (key == begun) {
    all.push_back({"method=", "how muscles are deformed"});
    all.push_back({"preset=", "settings to start from"});
    for (const SettingGroup& group : setting_groups(names)) {
      // Behind the first letters of a group its keys; before, the group.
      if (group.begin.empty() || begun.starts_with(group.begin))
        add_keys(group.begin, group.settings, all);
      else if (!group.settings.empty())
        all.push_back({group.begin, "settings of " + group.begin.substr(0, group.begin.size() - 1)});
    }
    return all;
  }
  if (key == "method")
    for (const MethodEntry& method : methods())
      all.push_back({"method=" + std::string(method.name), std::string(method.meaning)});
  if (key == "preset")
    for (const Preset& preset : presets())
      all.push_back({"preset=" + std::string(preset.name), std::string(preset.meaning)});
  for (const SettingGroup& group : setting_groups(names)) add_values(group.begin, group.settings, key, all);
  return all;
}

std::vector<Candidate> file_candidates(const std::string& description, const std::string& begun) {
  const std::vector<std::string> endings = endings_in(description);
  const auto says = [&](const char* words) { return description.find(words) != std::string::npos; };
  const bool runs = says("un folder") || says("nother run");
  if (endings.empty() && !runs && !says("older") && !says("File")) return {};
  const std::size_t slash = begun.rfind('/');
  const std::string folder = slash == std::string::npos ? "" : begun.substr(0, slash + 1);
  std::vector<Candidate> all;
  std::error_code error;
  fs::directory_iterator entries(folder.empty() ? fs::path(".") : expanded(folder), error);
  for (; !error && entries != fs::directory_iterator(); entries.increment(error)) {
    const std::string name = entries->path().filename().string();
    if (name.starts_with(".") && !begun.substr(folder.size()).starts_with(".")) continue;
    if (entries->is_directory(error)) {
      if (runs && is_there(entries->path() / "run.json"))
        all.push_back({folder + name, "run folder"});
      else
        all.push_back({folder + name + "/", ""});
    } else if (std::find(endings.begin(), endings.end(), entries->path().extension()) != endings.end() ||
               (endings.empty() && says("File"))) {
      all.push_back({folder + name, ""});
    }
  }
  std::sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) { return a.word < b.word; });
  return all;
}

}  // namespace gracilis
