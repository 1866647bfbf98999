#include "run_command.hpp"
#include "scene_options.hpp"
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
  add_scene_options(*command, options->file, options->scene);
  add_session_options(*command, options->session);
  command->add_flag("--arms", options->session.fiber_actions,
                    "Also write moment arms about every coordinate and lines of action, where the method knows them "
                    "(method strings)");
  options->session.command = words;
  command->callback([&chosen, options] {
    chosen = [options] { return run_session(read_scene(options->file, options->scene), options->session); };
  });
}

}  // namespace gracilis
