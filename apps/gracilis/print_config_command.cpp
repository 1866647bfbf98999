#include "print_config_command.hpp"

#include <gracilis/io/scene/scene_template.hpp>

#include <fmt/format.h>

namespace gracilis {

void add_print_config_command(CLI::App& program, Command& chosen) {
  CLI::App* command = program.add_subcommand(
      "print-config", "Write a complete scene file to stdout: every key explained, with unit, range and default");
  command->callback([&chosen] {
    chosen = [] {
      fmt::print("{}", scene_template());
      return 0;
    };
  });
}

}  // namespace gracilis
