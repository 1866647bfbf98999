#include "activations_command.hpp"
#include "bench_command.hpp"
#include "build_info.hpp"
#include "calibrate_command.hpp"
#include "command.hpp"
#include "compare_command.hpp"
#include "console.hpp"
#include "demo_command.hpp"
#include "exit_handling.hpp"
#include "export_command.hpp"
#include "fibers_command.hpp"
#include "hidden_commands.hpp"
#include "import_command.hpp"
#include "inspect_command.hpp"
#include "motions_command.hpp"
#include "new_command.hpp"
#include "option_text.hpp"
#include "paths_command.hpp"
#include "prepare_command.hpp"
#include "print_config_command.hpp"
#include "render_command.hpp"
#include "report_command.hpp"
#include "rom_command.hpp"
#include "run_command.hpp"
#include "scene_command.hpp"
#include "static_optimization_command.hpp"
#include "study_command.hpp"
#include "transfer_command.hpp"
#include "usage.hpp"
#include "verify_command.hpp"
#include "view_command.hpp"
#include "wrap_command.hpp"

#include <gracilis/core/errors.hpp>

#include <fmt/format.h>

#include <iostream>
#include <string>
#include <vector>

namespace gracilis {

/// What the words of the command line ask for; empty arguments ask for the first steps. Throws Error where they are no
/// command.
static int run_words(int count, char** arguments) {
  const std::vector<std::string> words(arguments, arguments + count);
  CLI::App program("Gracilis: bones, muscle surfaces and a motion become deforming, contracting muscles", "gracilis");
  program.formatter(std::make_shared<HelpText>());  // commands take theirs from the program
  bool as_json = false;
  CLI::Option* version = program.set_version_flag(
      "--version", [&as_json] { return as_json ? version_json() : version_text(); },
      "Say version, commit, compiler, instruction sets and components");
  program.add_flag("--json", as_json, "For programs")->trigger_on_parse()->needs(version);
  program.require_subcommand(1);
  Command chosen;
  add_demo_command(program, words, chosen);
  add_run_command(program, words, chosen);
  add_compare_command(program, words, chosen);
  add_rom_command(program, words, chosen);
  add_study_command(program, words, chosen);
  add_calibrate_command(program, chosen);
  add_fibers_command(program, chosen);
  add_activations_command(program, chosen);
  add_print_config_command(program, chosen);
  add_bench_command(program, chosen);
  add_inspect_command(program, chosen);
  add_render_command(program, chosen);
  add_export_command(program, chosen);
  add_report_command(program, chosen);
  add_verify_command(program, chosen);
  add_view_command(program, chosen);
  add_prepare_command(program, chosen);
  add_new_command(program, chosen);
  add_scene_command(program, chosen);
  add_transfer_command(program, words, chosen);
  add_import_command(program, chosen);
  add_wrap_command(program, chosen);
  add_motions_command(program, chosen);
  add_paths_command(program, chosen);
  add_static_optimization_command(program, chosen);
  add_examples(program);
  if (count < 2) {
    fmt::print("{}", first_steps());
    return static_cast<int>(ExitCode::done);
  }
  if (Command hidden = hidden_command(program, words)) return hidden();
  try {
    program.parse(count, arguments);
  } catch (const CLI::ParseError& error) {
    // Help and version are no errors; everything else is a usage error, whatever CLI11's own code for it.
    const bool asked_for = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success);
    const bool of_no_command = program.get_subcommands().empty() && !words[1].starts_with("-");
    if (!asked_for || of_no_command) throw Error(ExitCode::usage, usage_problem(program, error, words));
    program.exit(error, std::cout, std::cerr);
    return static_cast<int>(ExitCode::done);
  }
  return chosen();
}

}  // namespace gracilis

/// Exit codes: see ExitCode in core/errors.hpp.
int main(int count, char** arguments) {
  using namespace gracilis;
  open_closed_streams();
  ignore_size_signals();
  return run_guarded([&] {
    set_up_logging();
    return run_words(count, arguments);
  });
}
