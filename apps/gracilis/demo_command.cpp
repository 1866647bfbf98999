#include "demo_command.hpp"
#include "scene_options.hpp"
#include "session.hpp"

#include <gracilis/methods/registry.hpp>

#include <memory>

namespace gracilis {

/// "iliacus_r=0.3"
static std::pair<std::string, Real> activation_in(const std::string& word) {
  const std::size_t sign = word.find('=');
  Real value = 0;
  if (sign == std::string::npos || !CLI::detail::lexical_cast(word.substr(sign + 1), value))
    throw CLI::ValidationError("--activation", "'" + word + "' is not MUSCLE=VALUE, as in iliacus_r=0.3");
  return {word.substr(0, sign), value};
}

void add_demo_options(CLI::App& command, DemoOptions& demo, SceneOptions& changes) {
  command.add_option("SCENE", demo.scene, "Which joint: hip (default) or elbow")
      ->check(CLI::IsMember({"hip", "elbow"}));
  command.add_option("--flexion", demo.flexion_deg, "How far to flex, degrees (hip 90, elbow 130)")
      ->check(CLI::Range(0.0, 130.0));
  std::vector<std::string> names;
  for (const Preset& preset : presets()) names.emplace_back(preset.name);
  command.add_option("--preset", demo.preset, "Settings to use: the default or, to compare with, the published ones")
      ->check(CLI::IsMember(names));
  command
      .add_option("--contact", demo.contact,
                  "How muscles keep out of each other: surface, virtual-edges or none (default: as the preset says)")
      ->check(CLI::IsMember({"none", "surface", "virtual-edges"}));
  command
      .add_option_function<std::vector<std::string>>(
          "--activation",
          [&demo](const std::vector<std::string>& given) {
            for (const std::string& word : given) demo.activations.insert(activation_in(word));
          },
          "MUSCLE=VALUE, 0 to 1: how active it becomes with the flexion, as in iliacus_r=0.3; may be repeated")
      ->allow_extra_args(false);
  command.add_option("--step", demo.step_deg, "How far to flex in a frame, degrees (hip 1, elbow 2)")
      ->check(CLI::Range(0.01, 130.0));
  add_setting_options(command, changes);
  // Its motion is made by --flexion and --step, and its surfaces need no preparing: it takes no motion.KEY or
  // prepare.KEY.
  command.get_option("--set")->description(
      "KEY=VALUE, MUSCLE.KEY=VALUE, preset=NAME, method=NAME, distance_field.KEY=VALUE, contact.KEY=VALUE, "
      "sequence.KEY=VALUE, fibers.KEY=VALUE or contraction.KEY=VALUE; may be repeated");
}

void add_demo_command(CLI::App& program, const std::vector<std::string>& words, Command& chosen) {
  CLI::App* command = program.add_subcommand(
      "demo", "Flex the built-in hip by 90 degrees, or the built-in elbow by 130; no file needed");
  struct Options {
    DemoOptions demo;
    SceneOptions changes;
    SessionOptions session;
  };
  const auto options = std::make_shared<Options>();
  add_demo_options(*command, options->demo, options->changes);
  add_session_options(*command, options->session);
  options->session.command = words;
  command->callback([&chosen, options] {
    chosen = [options] { return run_session(load_demo(options->demo, options->changes), options->session); };
  });
}

}  // namespace gracilis
