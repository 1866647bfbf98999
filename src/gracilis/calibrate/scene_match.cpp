#include <gracilis/calibrate/scene_match.hpp>

#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/io/content_hash.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/scene/scene_layers.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/io/value_reader.hpp>
#include <gracilis/methods/registry.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <sstream>

namespace gracilis {

static std::optional<Real> number_in(const SettingValue& value) {
  if (const int* whole = std::get_if<int>(&value)) return *whole;
  if (const Real* number = std::get_if<Real>(&value)) return *number;
  return std::nullopt;
}

static SettingLookup not_found(const std::string& key, const std::vector<std::string>& known,
                               const std::string& where) {
  return {{}, {}, "there is no setting '" + key + "' " + where, suggestion(key, known)};
}

/// A setting that a struct of the scene holds; null: the scene has none of it.
template <class Settings>
static SettingLookup of_struct(const std::string& key, const std::string& owner, const Settings* settings) {
  if (const Setting<Settings>* setting = find_setting<Settings>(key))
    return {*setting, settings ? number_in(value_of(*settings, *setting)) : std::nullopt, "", ""};
  std::vector<std::string> known;
  for (const Setting<Settings>& each : setting_table<Settings>()) known.emplace_back(each.key);
  return not_found(key, known, "in [" + owner + "]");
}

static SettingLookup of_method(const Scene& scene, const std::string& key, const Muscle* muscle) {
  const MethodEntry& method = method_of(scene);
  std::vector<std::string> known;
  for (const DescribedSetting& each : method.settings) {
    known.emplace_back(each.key);
    if (each.key != key) continue;
    if (muscle && each.is_shared)
      return {{}, {}, "'" + key + "' holds for all muscles together", "leave the muscle's name away"};
    const auto of_all = scene.method.settings.find(key);
    const SettingValue all = of_all == scene.method.settings.end() ? each.default_value : of_all->second;
    return {each, number_in(muscle ? setting_of(scene, *muscle, each) : all), "", ""};
  }
  SettingLookup none = not_found(key, known, "of the method '" + std::string(method.name) + "'");
  if (nearest_word(key, known).empty()) none.remedy = "'gracilis print-config' lists all settings";
  return none;
}

static SettingLookup of_contact(const Scene& scene, const std::string& key) {
  std::vector<std::string> known;
  for (const DescribedSetting& each : method_of(scene).contact) {
    known.emplace_back(each.key);
    if (each.key != key) continue;
    const auto own = scene.method.contact.find(key);
    return {each, number_in(own == scene.method.contact.end() ? each.default_value : own->second), "", ""};
  }
  return not_found(key, known, "in [contact]");
}

SettingLookup look_up_setting(const Scene& scene, const std::string& key) {
  const std::size_t dot = key.rfind('.');
  const std::string owner = dot == std::string::npos ? "settings" : key.substr(0, dot);
  const std::string own = dot == std::string::npos ? key : key.substr(dot + 1);
  const Muscle* first = scene.muscles.empty() ? nullptr : &scene.muscles.front();
  if (owner == "settings") return of_method(scene, own, nullptr);
  if (owner == "contact") return of_contact(scene, own);
  if (owner == "distance_field") return of_struct(own, owner, &scene.distance_fields);
  if (owner == "sequence") return of_struct(own, owner, &scene.sequence);
  if (owner == "fibers") return of_struct<FiberSettings>(own, owner, first ? &first->fibers : nullptr);
  if (owner == "contraction") return of_struct<ContractionSettings>(own, owner, first ? &first->contraction : nullptr);
  if (owner == "surfaces") return of_struct<SurfaceSettings>(own, owner, nullptr);
  if (owner == "prepare") return of_struct<PrepareSettings>(own, owner, nullptr);
  std::vector<std::string> names;
  for (const Muscle& muscle : scene.muscles) {
    if (muscle.name == owner) return of_method(scene, own, &muscle);
    names.push_back(muscle.name);
  }
  names.insert(names.end(), setting_sections.begin(), setting_sections.end());
  return {{}, {}, "the scene has no muscle '" + owner + "'", suggestion(owner, names)};
}

namespace {

class SceneMatcher {
 public:
  SceneMatcher(const Calibration& calibration, const LoadedScene& loaded) : calibration_(calibration), loaded_(loaded) {
    for (const Muscle& muscle : loaded.scene.muscles) muscles_.push_back(muscle.name);
  }

  SceneMatch match() {
    for (const CalibrationTarget& target : calibration_.targets) look_at(target);
    for (const CalibrationParameter& parameter : calibration_.parameters) look_at(parameter);
    sort_problems();
    if (!problems_.empty()) throw ConfigurationError(problems_);
    for (const std::filesystem::path& file : loaded_.inputs)
      if (is_there(file)) result_.inputs += file.filename().string() + " " + content_hash(file) + "\n";
    result_.absent.assign(absent_.begin(), absent_.end());
    return result_;
  }

 private:
  void complain(const Problem& place, const std::string& what, const std::string& remedy) {
    problems_.push_back({place.file, place.where, what, remedy});
  }

  void sort_problems() {
    std::stable_sort(problems_.begin(), problems_.end(), [](const Problem& a, const Problem& b) {
      return std::atoi(a.where.c_str()) < std::atoi(b.where.c_str());
    });
  }

  const JointAxis* axis_of(const std::string& coordinate) const {
    for (const Joint& joint : loaded_.scene.joints)
      for (const JointAxis& axis : joint.axes)
        if (axis.coordinate == coordinate) return &axis;
    return nullptr;
  }

  void look_at_coordinate(const CalibrationTarget& target, const std::string& name, bool moves) {
    const JointAxis* axis = axis_of(name);
    if (!axis)
      complain(target.place, "the scene has no coordinate '" + name + "'",
               suggestion(name, coordinate_names(loaded_.scene)));
    else if (moves && axis->translation)
      complain(target.place, "'" + name + "' is a translation", "curves are over coordinates that are angles");
  }

  void look_at(const CalibrationTarget& target) {
    if (is_curve(target.kind)) look_at_coordinate(target, target.coordinate, true);
    for (const auto& [name, value] : target.pose) look_at_coordinate(target, name, false);
    bool has_any = false;
    std::set<std::string> missing;
    for (const TargetPart& part : target.parts) {
      const auto found = std::find(muscles_.begin(), muscles_.end(), part.muscle);
      if (found == muscles_.end()) {
        missing.insert(part.muscle);
        continue;
      }
      has_any = true;
      const Muscle& muscle = loaded_.scene.muscles[static_cast<std::size_t>(found - muscles_.begin())];
      if (is_curve(target.kind) && muscle.fibers.count == 0)
        complain(target.place, "'" + part.muscle + "' has no fibers, so no lengths and moment arms",
                 "set fibers.count above 0");
    }
    if (target.names_muscles && has_any)
      absent_.insert(missing.begin(), missing.end());
    else
      for (const std::string& name : missing)
        complain(target.place, "the scene has no muscle '" + name + "'", suggestion(name, muscles_));
  }

  void look_at(const CalibrationParameter& parameter) {
    const StudyParameter& setting = parameter.setting;
    const SettingLookup found = look_up_setting(loaded_.scene, setting.key);
    result_.starts.push_back(0);
    result_.whole.push_back(0);
    if (!found.info) return complain(parameter.place, found.objection, found.remedy);
    const SettingInfo& info = *found.info;
    if (info.kind != SettingKind::number && info.kind != SettingKind::integer)
      return complain(parameter.place, "'" + setting.key + "' is no number, but " + expectation(info),
                      "give it one value by --set");
    if (info.kind == SettingKind::integer && calibration_.search.method == SearchMethod::least_squares)
      return complain(parameter.place, "'" + setting.key + "' is a whole number, along which nothing has a slope",
                      "choose method = \"sbplx\" in [search], or give it one value by --set");
    if (setting.low < info.minimum || setting.high > info.maximum)
      return complain(parameter.place,
                      fmt::format("the bounds of '{}' are {} to {}", setting.key, setting.low, setting.high),
                      "it must be " + expectation(info));
    if (!parameter.start && !found.value)
      return complain(parameter.place, "the scene does not say what '" + setting.key + "' is", "give it a 'start'");
    const Real start = parameter.start.value_or(found.value.value_or(0));
    if (start < setting.low || start > setting.high)
      return complain(parameter.place,
                      fmt::format("the scene has {} = {}, outside of the bounds {} to {}", setting.key, start,
                                  setting.low, setting.high),
                      "widen them, or give a 'start'");
    result_.starts.back() = start;
    result_.whole.back() = info.kind == SettingKind::integer;
  }

  const Calibration& calibration_;
  const LoadedScene& loaded_;
  std::vector<std::string> muscles_;
  std::vector<Problem> problems_;
  std::set<std::string> absent_;
  SceneMatch result_;
};

}  // namespace

SceneMatch match_scene(const Calibration& calibration, const LoadedScene& loaded) {
  return SceneMatcher(calibration, loaded).match();
}

std::string to_text(const SceneMatch& match) {
  std::string text;
  for (std::size_t p = 0; p < match.starts.size(); ++p)
    text += (match.whole[p] ? "whole " : "start ") + to_text(match.starts[p]) + "\n";
  for (const std::string& name : match.absent) text += "absent " + name + "\n";
  return text + "inputs\n" + match.inputs;
}

SceneMatch match_from_text(const std::string& text) {
  SceneMatch match;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line) && line != "inputs";) {
    const std::size_t space = line.find(' ');
    const std::string word = line.substr(0, space), rest = line.substr(space + 1);
    if (word == "absent") {
      match.absent.push_back(rest);
      continue;
    }
    double start = 0;
    if (!parse_number(rest, start))
      throw InputError({"", "", "'" + shortened(rest) + "' is no start of a parameter", "calibrate again"});
    match.starts.push_back(start);
    match.whole.push_back(word == "whole");
  }
  match.inputs = text.substr(std::min(text.find("inputs\n") + 7, text.size()));
  return match;
}

void drop_absent(Calibration& calibration, const std::vector<std::string>& absent) {
  for (CalibrationTarget& target : calibration.targets)
    std::erase_if(target.parts, [&](const TargetPart& part) {
      return std::find(absent.begin(), absent.end(), part.muscle) != absent.end();
    });
}

}  // namespace gracilis
