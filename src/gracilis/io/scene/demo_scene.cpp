#include <gracilis/io/scene/demo_scene.hpp>

#include <gracilis/anatomy/builtin/builtin_elbow.hpp>
#include <gracilis/anatomy/builtin/builtin_hip.hpp>
#include <gracilis/anatomy/builtin/builtin_surfaces.hpp>
#include <gracilis/anatomy/scene_warnings.hpp>
#include <gracilis/io/scene/scene_changes.hpp>
#include <gracilis/methods/registry.hpp>

#include <string_view>

namespace gracilis {

namespace embedded {
extern const std::string_view builtin_hip_surfaces, builtin_elbow_surfaces;  // shaped when this was built
}

Scene demo_scene(const std::string& name, std::optional<Real> flexion) {
  if (name == "elbow") {
    BuiltinElbowOptions elbow;
    elbow.last_flexion = flexion.value_or(elbow.last_flexion);
    Scene scene = builtin_elbow_outline(elbow);
    put_surfaces(embedded::builtin_elbow_surfaces, scene);
    return scene;
  }
  BuiltinHipOptions hip;
  hip.last_flexion = flexion.value_or(hip.last_flexion);
  Scene scene = builtin_hip_outline(hip);
  put_surfaces(embedded::builtin_hip_surfaces, scene);
  return scene;
}

LoadedScene load_demo(const DemoOptions& options, const SceneOptions& changes) {
  LoadedScene loaded;
  const std::optional<Real>& flexion = options.flexion_deg;
  loaded.scene = demo_scene(options.scene, flexion ? std::optional(radians(*flexion)) : std::nullopt);
  loaded.preset = presets().front().name;
  if (options.preset != loaded.preset) change_to_preset(*find_preset(options.preset), loaded);
  if (!options.contact.empty()) loaded.scene.method.contact["muscle"] = options.contact;
  change_scene(loaded, changes.set, changes.only);
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
