#include <gracilis/io/scene/scene_description.hpp>

#include <gracilis/io/scene/activation.hpp>
#include <gracilis/io/scene/bodies.hpp>
#include <gracilis/io/scene/control_units.hpp>
#include <gracilis/io/scene/files.hpp>
#include <gracilis/io/scene/method_reader.hpp>
#include <gracilis/io/scene/motion.hpp>
#include <gracilis/io/scene/muscles.hpp>
#include <gracilis/io/scene/references.hpp>
#include <gracilis/io/scene/scene_layers.hpp>
#include <gracilis/io/scene/settings.hpp>
#include <gracilis/io/scene/transversals.hpp>
#include <gracilis/io/toml_reader.hpp>

#include <set>

namespace gracilis {

static void check_schema(TomlReader& top, const std::filesystem::path& path, std::vector<Problem>& problems) {
  if (!top.has("schema")) {
    problems.push_back({path.string(), "", "the scene file does not say which schema it follows", "add: schema = 1"});
  } else if (top.number("schema").value_or(0) != 1) {
    top.add_problem("schema", "only schema 1 is known to this version");
  }
}

static void read_landmark_file(TomlReader& top, NamedFile& file) {
  std::optional<TomlReader> landmarks = top.table("landmarks");
  if (!landmarks) return;
  file = sections::named_file(*landmarks, landmarks->required_text("file"));
  landmarks->reject_unknown_keys();
}

static void read_muscles(TomlReader& top, SceneDescription& description, const sections::MuscleDefaults& defaults,
                         std::set<std::string>& of_other_methods) {
  for (TomlReader& muscle : top.tables("muscles"))
    description.muscles.push_back(sections::read_muscle(std::move(muscle), defaults, of_other_methods));
  sections::share_settings(defaults.method, description);
  if (!of_other_methods.empty())
    description.notes.push_back(note_on_others(description.scene.method.name, of_other_methods));
}

template <class Description>
static void read_list(TomlReader& top, const std::string& key, Description (*read)(TomlReader),
                      std::vector<Description>& list) {
  for (TomlReader& each : top.tables(key)) list.push_back(read(std::move(each)));
}

static void keep_only(TomlReader& top, const std::vector<std::string>& only, SceneDescription& description,
                      std::vector<Problem>& problems) {
  const Problem place = top.has("only") ? place_of(*top.find("only")) : Problem{};
  sections::keep_only(description.muscles, top.texts("only"), place, problems);
  sections::keep_only(description.muscles, only, {"--only", "", "", ""}, problems);
}

static SceneDescription describe(const SceneLayers& layers, const std::filesystem::path& path,
                                 const std::vector<std::string>& only, Index surfaces) {
  std::vector<Problem> problems;
  TomlReader top(layers.table, "the scene file", problems);
  SceneDescription description;
  description.files = layers.files;
  description.notes = layers.notes;

  check_schema(top, path, problems);
  description.scene.name = top.text("name").value_or(path.stem().string());
  description.guessed = top.texts("guessed");
  std::set<std::string> of_other_methods;
  const sections::MuscleDefaults defaults = sections::read_settings(top, description, of_other_methods);
  read_landmark_file(top, description.landmarks);
  read_list(top, "bones", sections::read_bone, description.bones);
  read_list(top, "joints", sections::read_joint, description.joints);
  read_muscles(top, description, defaults, of_other_methods);
  if (std::optional<TomlReader> motion = top.table("motion"))
    description.motion = sections::read_motion(std::move(*motion));
  read_list(top, "activations", sections::read_activation, description.activations);
  read_list(top, "joint_control_units", sections::read_control_unit, description.control_units);
  read_list(top, "transversals", sections::read_transversal, description.transversals);
  sections::check_references(description, problems);
  sections::check_given(description, surfaces, problems);
  keep_only(top, only, description, problems);
  top.reject_unknown_keys();
  sort_by_place(problems);
  if (!problems.empty()) throw ConfigurationError(problems);
  return description;
}

SceneDescription read_scene_description(const std::filesystem::path& path, const std::vector<std::string>& set,
                                        const std::vector<std::string>& only) {
  return describe(load_scene_layers(path, set), path, only, 0);
}

SceneDescription read_given_description(const toml::table& tables, Index surfaces) {
  SceneDescription description = describe({tables, {}, {}}, "", {}, surfaces);
  if (description.scene.name.empty()) description.scene.name = "scene";
  return description;
}

}  // namespace gracilis
