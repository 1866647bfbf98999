#include "demo_command.hpp"
#include "scene_options.hpp"
#include "session.hpp"

#include <gracilis/anatomy/builtin/builtin_elbow.hpp>
#include <gracilis/anatomy/builtin/builtin_hip.hpp>
#include <gracilis/anatomy/scene_warnings.hpp>
#include <gracilis/io/scene/scene_changes.hpp>
#include <gracilis/methods/registry.hpp>

#include <memory>

namespace gracilis {

Scene demo_scene(const std::string& name, std::optional<Real> flexion) {
  if (name == "elbow") {
    BuiltinElbowOptions elbow;
    elbow.last_flexion = flexion.value_or(elbow.last_flexion);
    return builtin_elbow(elbow);
  }
  BuiltinHipOptions hip;
  hip.last_flexion = flexion.value_or(hip.last_flexion);
  return builtin_hip(hip);
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

void add_demo_command(CLI::App& program, const std::vector<std::string>& words, Command& chosen) {
  CLI::App* command = program.add_subcommand(
      "demo", "Flex the built-in hip by 90 degrees, or the built-in elbow by 130; no file needed");
  struct Options {
    DemoOptions demo;
    SceneOptions scene_options;
    SessionOptions session;
  };
  const auto options = std::make_shared<Options>();
  command->add_option("SCENE", options->demo.scene, "Which joint: hip (default) or elbow")
      ->check(CLI::IsMember({"hip", "elbow"}));
  command->add_option("--flexion", options->demo.flexion_deg, "How far to flex, degrees (hip 90, elbow 130)")
      ->check(CLI::Range(0.0, 130.0));
  std::vector<std::string> names;
  for (const Preset& preset : presets()) names.emplace_back(preset.name);
  command
      ->add_option("--preset", options->demo.preset,
                   "Settings to use: the default or, to compare with, the published ones")
      ->check(CLI::IsMember(names));
  command
      ->add_option("--contact", options->demo.contact,
                   "How muscles keep out of each other: surface, virtual-edges or none (default: as the preset says)")
      ->check(CLI::IsMember({"none", "surface", "virtual-edges"}));
  add_setting_options(*command, options->scene_options);
  add_session_options(*command, options->session);
  options->session.command = words;
  command->callback([&chosen, options] {
    chosen = [options] { return run_session(load_demo(options->demo, options->scene_options), options->session); };
  });
}

}  // namespace gracilis
