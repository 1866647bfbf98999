#include "demo_command.hpp"
#include "session.hpp"

#include <gracilis/anatomy/builtin_hip.hpp>
#include <gracilis/anatomy/scene_warnings.hpp>

#include <memory>

namespace gracilis {

void add_demo_command(CLI::App& program, const std::vector<std::string>& words, Command& chosen) {
  CLI::App* command = program.add_subcommand("demo", "Flex the built-in hip by 90 degrees; no file needed");
  const auto options = std::make_shared<SessionOptions>();
  add_session_options(*command, *options);
  options->command = words;
  command->callback([&chosen, options] {
    chosen = [options] {
      LoadedScene loaded;
      loaded.scene = builtin_hip();
      loaded.preset = "physical";
      loaded.warnings = warnings_about(loaded.scene);
      return run_session(loaded, *options);
    };
  });
}

}  // namespace gracilis
