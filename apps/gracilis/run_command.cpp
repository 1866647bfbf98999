#include "run_command.hpp"
#include "session.hpp"

#include <memory>

namespace gracilis {

void add_run_command(CLI::App& program, const std::vector<std::string>& words, Command& chosen) {
  struct Options {
    std::filesystem::path file;
    SceneOptions scene;
    SessionOptions session;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("run", "Run a scene file through its whole motion");
  command->add_option("SCENE", options->file, "Scene file (TOML); 'gracilis print-config' writes one")->required();
  command->add_option("--data", options->scene.data,
                      "Folder with the scene's files (default: GRACILIS_DATA, or shared/data above the scene file)");
  command
      ->add_option(
          "--set", options->scene.set,
          "KEY=VALUE, MUSCLE.KEY=VALUE, preset=NAME, distance_field.KEY=VALUE or sequence.KEY=VALUE; may be repeated. "
          "A key for all muscles leaves those alone that the file gives one of their own")
      ->allow_extra_args(false);
  command->add_option("--only", options->scene.only, "Keep these muscles only; names separated by commas")
      ->delimiter(',')
      ->allow_extra_args(false);
  add_session_options(*command, options->session);
  options->session.command = words;
  command->callback([&chosen, options] {
    chosen = [options] { return run_session(read_scene(options->file, options->scene), options->session); };
  });
}

}  // namespace gracilis
