#include "scene_options.hpp"
#include "handed_preparation.hpp"

namespace gracilis {

void add_scene_options(CLI::App& command, std::filesystem::path& file, SceneOptions& options) {
  options.prepare = scene_preparation();
  options.say = log_lines;
  command.add_option("SCENE", file, "Scene file (TOML); 'gracilis print-config' writes one")->required();
  command.add_option("--data", options.data,
                     "Folder with the scene's files (default: GRACILIS_DATA, or shared/data above the scene file)");
  add_setting_options(command, options);
}

void add_setting_options(CLI::App& command, SceneOptions& options) {
  command
      .add_option(
          "--set", options.set,
          "KEY=VALUE, MUSCLE.KEY=VALUE, preset=NAME, method=NAME, distance_field.KEY=VALUE, contact.KEY=VALUE, "
          "sequence.KEY=VALUE, "
          "motion.KEY=VALUE (motion.step_deg=0.25), fibers.KEY=VALUE, contraction.KEY=VALUE or prepare.KEY=VALUE; may "
          "be repeated. A key for all muscles leaves those alone that the file gives one of their own")
      ->allow_extra_args(false);
  command.add_option("--only", options.only, "Keep these muscles only; names separated by commas")
      ->delimiter(',')
      ->allow_extra_args(false);
}

}  // namespace gracilis
