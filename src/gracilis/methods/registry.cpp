#include <gracilis/methods/registry.hpp>

#include <gracilis/methods/every_method.hpp>
#include <gracilis/scene/validate_sizes.hpp>
#include <gracilis/strings/bone_distances.hpp>

#include <cassert>
#include <optional>
#include <string>

namespace gracilis {

const std::vector<MethodEntry>& methods() {
  static const std::vector<MethodEntry> all = every_method();
  return all;
}

const MethodEntry* find_method(std::string_view name) {
  for (const MethodEntry& method : methods())
    if (method.name == name) return &method;
  return nullptr;
}

const MethodEntry& method_of(const Scene& scene) {
  const MethodEntry* method = find_method(scene.method.name);
  assert(method);
  return *method;
}

static const DescribedSetting* find(const std::vector<DescribedSetting>& table, std::string_view key) {
  for (const DescribedSetting& setting : table)
    if (setting.key == key) return &setting;
  return nullptr;
}

static void check_values(const std::string& where, const std::vector<DescribedSetting>& table,
                         const SettingValues& values, const Muscle* muscle, std::vector<Problem>& problems) {
  for (const auto& [key, value] : values) {
    const DescribedSetting* setting = find(table, key);
    if (!setting)
      problems.push_back({"", where, "the method has no setting '" + key + "'", ""});
    else if (!accepted(*setting, value))
      problems.push_back({"", where, "'" + key + "' must be " + expectation(*setting), ""});
    else if (muscle && setting->is_shared)
      problems.push_back({"", where, "'" + key + "' holds for all muscles together", "set it for the scene"});
  }
}

std::vector<Problem> validate_method(const Scene& scene) {
  const MethodEntry* method = find_method(scene.method.name);
  if (!method) return {{"", "", "there is no method '" + scene.method.name + "'", ""}};
  std::vector<Problem> problems;
  check_values("settings", method->settings, scene.method.settings, nullptr, problems);
  check_values("contact", method->contact, scene.method.contact, nullptr, problems);
  for (const Muscle& muscle : scene.muscles)
    check_values("muscle '" + muscle.name + "'", method->settings, muscle.settings, &muscle, problems);
  if (!scene.transversals.empty() && !method->takes_transversals)
    problems.push_back({"", "[[transversals]]", "the method '" + scene.method.name + "' lets no sections give way",
                        "run it by method = \"cylinder\", or leave them out"});
  if (method->validate)
    for (Problem& own : method->validate(scene)) problems.push_back(std::move(own));
  if (!problems.empty() || !method->has_far_fields || !method->has_far_fields(scene)) return problems;
  const Problem asked = {"", "strings", "pulling fibers tight",
                         "check the units of the bones, or cut away what is far"};
  if (std::optional<Problem> far = grid_problem(scene, strings::far_field_settings(), asked))
    problems.push_back(std::move(*far));
  return problems;
}

std::unique_ptr<DeformationMethod> make_method(const Scene& scene, const BoneFieldSource& fields) {
  return method_of(scene).make(scene, fields);
}

bool keeps_surfaces_apart(const Scene& scene) {
  const MethodEntry& method = method_of(scene);
  return method.has_surface_contact && method.has_surface_contact(scene);
}

int resume_period(const Scene& scene) {
  const MethodEntry& method = method_of(scene);
  return method.resume_period ? method.resume_period(scene) : 1;
}

std::vector<Preset> presets() {
  std::vector<Preset> all;
  for (const MethodEntry& method : methods()) all.insert(all.end(), method.presets.begin(), method.presets.end());
  return all;
}

std::optional<Preset> find_preset(std::string_view name) {
  for (const Preset& preset : presets())
    if (preset.name == name) return preset;
  return std::nullopt;
}

SettingValue setting_of(const Scene& scene, const Muscle& muscle, const DescribedSetting& setting) {
  for (const SettingValues* values : {&muscle.settings, &scene.method.settings})
    if (const auto found = values->find(setting.key); found != values->end())
      return accepted(setting, found->second).value_or(setting.default_value);
  return setting.default_value;
}

Real tendon_length_of(const Scene& scene, const Muscle& muscle) {
  constexpr Real usual = 0.03;
  const DescribedSetting* setting = find(method_of(scene).settings, "tendon_length");
  return setting ? std::get<Real>(setting_of(scene, muscle, *setting)) : usual;
}

}  // namespace gracilis
