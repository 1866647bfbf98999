#include <gracilis/io/scene/demo_scene.hpp>

#include <gracilis/anatomy/activation/activation.hpp>
#include <gracilis/anatomy/builtin/builtin_elbow.hpp>
#include <gracilis/anatomy/builtin/builtin_hip.hpp>
#include <gracilis/anatomy/builtin/builtin_surfaces.hpp>
#include <gracilis/anatomy/scene_warnings.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/io/scene/scene_changes.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/methods/registry.hpp>

#include <algorithm>
#include <string_view>

namespace gracilis {

namespace embedded {
extern const std::string_view builtin_hip_surfaces, builtin_elbow_surfaces;  // shaped when this was built
}

Scene demo_scene(const std::string& name, std::optional<Real> flexion, std::optional<Real> step) {
  if (name == "elbow") {
    BuiltinElbowOptions elbow;
    elbow.last_flexion = flexion.value_or(elbow.last_flexion);
    elbow.flexion_step = step.value_or(elbow.flexion_step);
    Scene scene = builtin_elbow_outline(elbow);
    put_surfaces(embedded::builtin_elbow_surfaces, scene);
    return scene;
  }
  BuiltinHipOptions hip;
  hip.last_flexion = flexion.value_or(hip.last_flexion);
  hip.flexion_step = step.value_or(hip.flexion_step);
  Scene scene = builtin_hip_outline(hip);
  put_surfaces(embedded::builtin_hip_surfaces, scene);
  return scene;
}

/// Each muscle's activation rises with the motion's first coordinate.
static void activate(const std::map<std::string, Real>& activations, Scene& scene) {
  std::vector<std::string> names;
  for (const Muscle& muscle : scene.muscles) names.push_back(muscle.name);
  for (const auto& [muscle, last] : activations) {
    if (std::find(names.begin(), names.end(), muscle) == names.end())
      throw ConfigurationError({"", "the built-in scene", "has no muscle '" + muscle + "'", suggestion(muscle, names)});
    if (!(last >= 0 && last <= 1))
      throw ConfigurationError({"", "muscle " + muscle, "its activation is not within 0 and 1", ""});
    const Eigen::VectorXd angles = scene.motion.values.col(0);
    Eigen::MatrixX2d points(2, 2);
    points << angles[0], 0, std::max(angles[angles.size() - 1], angles[0] + radians(1)), last;
    scene.activation.functions.push_back({muscle, along_coordinate(0, points)});
  }
}

LoadedScene load_demo(const DemoOptions& options, const SceneOptions& changes) {
  LoadedScene loaded;
  const auto angle = [](const std::optional<Real>& degrees) {
    return degrees ? std::optional(radians(*degrees)) : std::nullopt;
  };
  loaded.scene = demo_scene(options.scene, angle(options.flexion_deg), angle(options.step_deg));
  loaded.preset = presets().front().name;
  if (options.preset != loaded.preset) change_to_preset(*find_preset(options.preset), loaded);
  if (!options.contact.empty()) loaded.scene.method.contact["muscle"] = options.contact;
  change_scene(loaded, changes.set, changes.only);
  activate(options.activations, loaded.scene);
  for (std::string& warning : warnings_about(loaded.scene)) loaded.warnings.push_back(std::move(warning));
  return loaded;
}

std::optional<std::string> builtin_scene_of(const std::string& word) {
  if (word == "demo") return "hip";
  if (word == "demo-elbow") return "elbow";
  return {};
}

LoadedScene load_scene(const std::string& file_or_word, const SceneOptions& options, std::optional<Real> flexion_deg) {
  const std::optional<std::string> builtin = builtin_scene_of(file_or_word);
  if (!builtin) return read_scene(file_or_word, options);
  DemoOptions demo;
  demo.scene = *builtin;
  demo.flexion_deg = flexion_deg;
  return load_demo(demo, options);
}

}  // namespace gracilis
