#include <gracilis/io/scene/settings.hpp>

#include <gracilis/io/scene/method_reader.hpp>
#include <gracilis/methods/registry.hpp>

#include <cmath>
#include <optional>

namespace gracilis::sections {

static void read_axes(TomlReader& top, AnatomicalAxes& axes) {
  const Vec3 anterior = top.vector("anterior").value_or(axes.anterior);
  const Vec3 superior = top.vector("superior").value_or(axes.superior);
  if (!(anterior.norm() > 0 && superior.norm() > 0 &&
        std::abs(anterior.normalized().dot(superior.normalized())) < 0.1)) {
    top.add_problem(top.has("superior") ? "superior" : "anterior", "'anterior' and 'superior' are not at right angles",
                    "give both, as in anterior = [0, -1, 0] and superior = [0, 0, 1]");
    return;
  }
  axes.superior = superior.normalized();
  axes.anterior = (anterior - anterior.dot(axes.superior) * axes.superior).normalized();
}

/// The method is the one that is named, else the preset's.
static MuscleDefaults start_from_preset(TomlReader& top, SceneDescription& description) {
  description.preset = top.text("preset").value_or(std::string(presets().front().name));
  Scene& scene = description.scene;
  const std::optional<Preset> preset = named_preset(top, description.preset);
  if (preset) scene.method.name = preset->method.name;
  MuscleDefaults defaults{read_method(top, scene.method)};
  if (!preset) return defaults;
  if (preset->method.name == scene.method.name) scene.method = preset->method;
  scene.distance_fields = preset->distance_fields;
  defaults.contraction = preset->contraction;
  return defaults;
}

template <class Settings>
static void read_section(TomlReader& top, const std::string& key, Settings& settings) {
  std::optional<TomlReader> section = top.table(key);
  if (!section) return;
  section->read_settings(settings);
  section->reject_unknown_keys();
}

static void read_preparation(TomlReader& top, SceneDescription& description) {
  std::optional<TomlReader> section = top.table("prepare");
  if (!section) return;
  section->read_settings(description.prepare.emplace());
  description.apart = section->texts("apart");
  if (!description.apart.empty() && description.prepare->keep_overlaps)
    section->add_problem("apart", "pulls muscles apart, and overlaps are to be kept", "leave out one of the two");
  section->reject_unknown_keys();
}

/// [settings] and [contact].
static void read_method_tables(TomlReader& top, const MethodEntry& method, MethodChoice& choice,
                               std::set<std::string>& others) {
  const auto read = [&](const char* key, std::vector<DescribedSetting> MethodEntry::*which, SettingValues& values,
                        std::set<std::string>& unused) {
    std::optional<TomlReader> section = top.table(key);
    if (!section) return;
    read_method_settings(*section, method, which, values, unused);
    section->reject_unknown_keys();
  };
  read("settings", &MethodEntry::settings, choice.settings, others);
  std::set<std::string> unused_contact;
  read("contact", &MethodEntry::contact, choice.contact, unused_contact);
}

MuscleDefaults read_settings(TomlReader& top, SceneDescription& description, std::set<std::string>& others) {
  Scene& scene = description.scene;
  MuscleDefaults defaults = start_from_preset(top, description);
  read_axes(top, scene.axes);
  read_method_tables(top, defaults.method, scene.method, others);
  read_section(top, "surfaces", description.surfaces);
  read_section(top, "distance_field", scene.distance_fields);
  read_section(top, "sequence", scene.sequence);
  read_section(top, "fibers", defaults.fibers);
  read_section(top, "contraction", defaults.contraction);
  if (top.has("prepare")) read_preparation(top, description);
  return defaults;
}

/// Whether a muscle's wish counts instead of another one: the larger number, and the later of what is no number.
static bool counts_before(const SettingValue& wish, const SettingValue& other) {
  const auto number_in = [](const SettingValue& value) -> std::optional<Real> {
    if (const int* integer = std::get_if<int>(&value)) return *integer;
    const Real* number = std::get_if<Real>(&value);
    return number ? std::optional(*number) : std::nullopt;
  };
  const std::optional<Real> own = number_in(wish), others = number_in(other);
  return !own || !others || *own > *others;
}

void share_settings(const MethodEntry& method, SceneDescription& description) {
  for (const DescribedSetting& setting : method.settings) {
    const std::string key(setting.key);
    bool is_given = false;
    for (MuscleDescription& each : description.muscles) {
      SettingValues& of_muscle = each.muscle.settings;
      const auto own = of_muscle.find(key);
      if (!setting.is_shared || own == of_muscle.end()) continue;
      SettingValue& all = description.scene.method.settings.emplace(key, setting.default_value).first->second;
      if (counts_before(own->second, all)) all = own->second;
      of_muscle.erase(own);
      is_given = true;
    }
    if (is_given)
      description.notes.push_back("'" + key + "' holds for all muscles together; the largest value given is taken");
  }
}

}  // namespace gracilis::sections
