#include "demo_command.hpp"
#include "session.hpp"

#include <gracilis/anatomy/builtin_hip.hpp>
#include <gracilis/anatomy/scene_warnings.hpp>
#include <gracilis/scene/presets.hpp>
#include <gracilis/scene/setting_table.hpp>

#include <memory>

namespace gracilis {

static void apply_preset(const Preset& preset, Scene& scene) {
  scene.distance_fields = preset.distance_fields;
  scene.contact = preset.contact;
  for (Muscle& muscle : scene.muscles) muscle.xpbd = preset.xpbd;
}

void add_demo_command(CLI::App& program, const std::vector<std::string>& words, Command& chosen) {
  CLI::App* command = program.add_subcommand("demo", "Flex the built-in hip by 90 degrees; no file needed");
  struct Options {
    std::string preset = "physical", contact;
    SessionOptions session;
  };
  const auto options = std::make_shared<Options>();
  std::vector<std::string> names;
  for (const Preset& preset : presets()) names.emplace_back(preset.name);
  command
      ->add_option("--preset", options->preset, "Settings to use: the default or, to compare with, the published ones")
      ->check(CLI::IsMember(names));
  command
      ->add_option("--contact", options->contact,
                   "How muscles keep out of each other: surface, virtual-edges or none (default: as the preset says)")
      ->check(CLI::IsMember({"none", "surface", "virtual-edges"}));
  add_session_options(*command, options->session);
  options->session.command = words;
  command->callback([&chosen, options] {
    chosen = [options] {
      LoadedScene loaded;
      loaded.scene = builtin_hip();
      loaded.preset = options->preset;
      if (loaded.preset != "physical") apply_preset(*find_preset(loaded.preset), loaded.scene);
      if (!options->contact.empty())
        assign(loaded.scene.contact, *find_setting<ContactSettings>("muscle"), options->contact);
      loaded.warnings = warnings_about(loaded.scene);
      return run_session(loaded, options->session);
    };
  });
}

}  // namespace gracilis
