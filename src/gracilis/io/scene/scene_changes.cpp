#include <gracilis/io/scene/scene_changes.hpp>

#include <gracilis/io/scene/method_reader.hpp>
#include <gracilis/io/scene/scene_layers.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/scene/validate_sizes.hpp>

#include <algorithm>
#include <set>

namespace gracilis {

void change_to_preset(const Preset& preset, LoadedScene& loaded) {
  Scene& scene = loaded.scene;
  loaded.preset = preset.name;
  scene.method = preset.method;
  scene.distance_fields = preset.distance_fields;
  for (Muscle& muscle : scene.muscles) {
    muscle.settings.clear();
    muscle.contraction = preset.contraction;
  }
}

namespace {

/// What a table of the layers says of a struct of settings.
template <class Settings>
SettingValues read_values(TomlReader& top, const std::string& key) {
  SettingValues values;
  std::optional<TomlReader> table = top.table(key);
  if (!table) return values;
  for (const Setting<Settings>& setting : setting_table<Settings>())
    if (const std::optional<SettingValue> value = table->setting(setting)) values[std::string(setting.key)] = *value;
  table->reject_unknown_keys();
  return values;
}

void read_preset(TomlReader& top, LoadedScene& loaded) {
  const std::optional<std::string> name = top.text("preset");
  if (!name) return;
  if (const std::optional<Preset> preset = named_preset(top, *name)) change_to_preset(*preset, loaded);
}

void read_method_tables(TomlReader& top, const MethodEntry& method, Scene& scene, std::set<std::string>& others) {
  if (std::optional<TomlReader> table = top.table("settings")) {
    SettingValues all;
    read_method_settings(*table, method, &MethodEntry::settings, all, others);
    table->reject_unknown_keys();
    for (const auto& [key, value] : all) {
      scene.method.settings[key] = value;
      for (Muscle& muscle : scene.muscles) muscle.settings.erase(key);
    }
  }
  if (std::optional<TomlReader> table = top.table("contact")) {
    read_method_settings(*table, method, &MethodEntry::contact, scene.method.contact, others);
    table->reject_unknown_keys();
  }
  for (TomlReader& table : top.tables("muscles")) {
    const std::string name = table.required_text("name");
    std::optional<TomlReader> own = table.table("settings");
    for (Muscle& muscle : scene.muscles)
      if (own && muscle.name == name)
        read_method_settings(*own, method, &MethodEntry::settings, muscle.settings, others);
    if (own) own->reject_unknown_keys();
    table.reject_unknown_keys();
  }
}

void keep_only(Scene& scene, const std::vector<std::string>& only, const std::vector<std::string>& names,
               std::vector<Problem>& problems) {
  if (only.empty()) return;
  for (const std::string& name : only)
    if (std::find(names.begin(), names.end(), name) == names.end())
      problems.push_back({"--only", "", "there is no muscle '" + name + "'", suggestion(name, names)});
  std::vector<Index> number(scene.muscles.size(), -1);
  for (std::size_t m = 0, kept = 0; m < scene.muscles.size(); ++m)
    if (std::find(only.begin(), only.end(), scene.muscles[m].name) != only.end())
      number[m] = static_cast<Index>(kept++);
  for (MuscleBody& each : scene.muscle_bodies) {
    const std::string& name = scene.muscles[static_cast<std::size_t>(each.muscle)].name;
    each.muscle = number[static_cast<std::size_t>(each.muscle)];
    if (each.muscle < 0)
      problems.push_back({"--only", "", "a muscle lies on " + name + ", which is left out", "name " + name + ", too"});
  }
  std::erase_if(scene.muscles,
                [&](const Muscle& muscle) { return std::find(only.begin(), only.end(), muscle.name) == only.end(); });
}

/// The method that the layers name. What the scene was made with for another one is dropped: a key may mean something
/// else, or be one of all muscles together.
const MethodEntry& change_method(TomlReader& top, Scene& scene) {
  const std::string before = scene.method.name;
  const MethodEntry& method = read_method(top, scene.method);
  if (scene.method.name == before) return method;
  scene.method = {scene.method.name};
  for (Muscle& muscle : scene.muscles) muscle.settings.clear();
  return method;
}

/// What the scene's method has no setting for.
void drop_settings_of_others(const MethodEntry& method, Scene& scene) {
  const auto drop = [](const std::vector<DescribedSetting>& table, SettingValues& values) {
    std::erase_if(values, [&](const auto& entry) {
      return std::none_of(table.begin(), table.end(),
                          [&](const DescribedSetting& setting) { return setting.key == entry.first; });
    });
  };
  drop(method.settings, scene.method.settings);
  drop(method.contact, scene.method.contact);
  for (Muscle& muscle : scene.muscles) drop(method.settings, muscle.settings);
}

}  // namespace

void change_scene(LoadedScene& loaded, const std::vector<std::string>& set, const std::vector<std::string>& only) {
  Scene& scene = loaded.scene;
  std::vector<std::string> names;
  for (const Muscle& muscle : scene.muscles) names.push_back(muscle.name);
  const SceneLayers layers = command_line_layers(set, names);
  std::vector<Problem> problems;
  std::set<std::string> others;
  TomlReader top(layers.table, "what --set may change here", problems);
  read_preset(top, loaded);
  const MethodEntry& method = change_method(top, scene);
  drop_settings_of_others(method, scene);
  read_method_tables(top, method, scene, others);
  scene.distance_fields = with_values(scene.distance_fields, read_values<DistanceFieldSettings>(top, "distance_field"));
  scene.sequence = with_values(scene.sequence, read_values<Sequence>(top, "sequence"));
  const SettingValues fibers = read_values<FiberSettings>(top, "fibers");
  const SettingValues contraction = read_values<ContractionSettings>(top, "contraction");
  for (Muscle& muscle : scene.muscles) {
    muscle.fibers = with_values(muscle.fibers, fibers);
    muscle.contraction = with_values(muscle.contraction, contraction);
  }
  keep_only(scene, only, names, problems);
  top.reject_unknown_keys();
  if (problems.empty()) problems = size_problems(scene);
  if (problems.empty()) problems = validate_method(scene);
  if (!problems.empty()) throw ConfigurationError(problems);
  if (!others.empty()) loaded.warnings.push_back(note_on_others(scene.method.name, others));
}

}  // namespace gracilis
