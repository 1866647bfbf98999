#include <gracilis/io/scene/scene_template.hpp>

#include "app/program.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace gracilis {

using testing::HasSubstr;

TEST(CommandLine, help_and_version_go_to_stdout_and_are_no_errors) {
  const ProgramResult version = run_program("--version");
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_TRUE(version.out.starts_with("gracilis 0.")) << version.out;
  EXPECT_EQ(version.err, "");
  const ProgramResult help = run_program("--help");
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out, HasSubstr("print-config"));
}

TEST(CommandLine, usage_errors_exit_with_2_and_keep_stdout_clean) {
  for (const char* arguments : {"--no-such-option", "no-such-command", "print-config extra"}) {
    const ProgramResult result = run_program(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_EQ(result.out, "") << arguments;
    EXPECT_NE(result.err, "") << arguments;
  }
}

TEST(CommandLine, without_a_word_the_first_steps_are_shown) {
  const ProgramResult result = run_program("");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("gracilis demo"));
  EXPECT_THAT(result.out, HasSubstr("--help"));
}

TEST(CommandLine, what_was_probably_meant_is_suggested) {
  const auto problem = [](const char* arguments) { return run_program(arguments).err; };
  EXPECT_THAT(problem("rnu leg.toml"), HasSubstr("there is no command 'rnu' (did you mean 'run'?"));
  EXPECT_THAT(problem("rnu --help"), HasSubstr("there is no command 'rnu' (did you mean 'run'?"));
  EXPECT_THAT(problem("verify leg --otu"), HasSubstr("there is no option '--otu'"));
  EXPECT_THAT(problem("report leg --otu=x"), HasSubstr("did you mean '--out'?"));
  EXPECT_THAT(problem("run"), HasSubstr("`gracilis run --help`"));
}

TEST(CommandLine, what_was_probably_meant_is_suggested_within_commands_and_among_choices_too) {
  const auto problem = [](const char* arguments) { return run_program(arguments).err; };
  EXPECT_THAT(problem("study rnu x"), HasSubstr("study: there is no command 'rnu' (did you mean 'run'?; "
                                                "`gracilis study --help` lists all)"));
  EXPECT_THAT(problem("activations jion"), HasSubstr("there is no command 'jion' (did you mean 'join'?"));
  EXPECT_THAT(problem("study run x --trheads 2"), HasSubstr("study run: there is no option '--trheads' (did you mean "
                                                            "'--threads'?; `gracilis study run --help`"));
  EXPECT_THAT(problem("render leg --out a.png --view laterl"),
              HasSubstr("render: --view does not know 'laterl' (did you mean 'lateral'?; `gracilis render --help`"));
  EXPECT_THAT(problem("run leg.toml --metrics ligth --layout compact"),
              HasSubstr("--metrics does not know 'ligth' (did you mean 'light'?"));
  EXPECT_THAT(problem("run leg.toml --layout compact --metrics ligth"), HasSubstr("did you mean 'light'?"));
}

/// Every command and its options as their help has them.
TEST(CommandLine, every_help_ends_with_an_example_that_uses_its_own_options) {
  std::istringstream lines(run_program("--help").out);
  int commands = 0;
  for (std::string line; std::getline(lines, line) && line != "Subcommands:";) {
  }
  for (std::string line; std::getline(lines, line) && !line.empty();) {
    if (line.size() < 3 || line[2] == ' ') continue;  // a description goes on
    const std::string command = line.substr(2, line.find(' ', 2) - 2);
    std::string help = run_program(command + " --help").out;
    const std::size_t begin = help.find("Example: gracilis " + command);
    ASSERT_NE(begin, std::string::npos) << command;
    ++commands;
    std::istringstream example(help.substr(begin));
    if (help.find("Subcommands:") != std::string::npos) {
      std::string subcommand;
      example >> subcommand >> subcommand >> subcommand >> subcommand;
      help = run_program(command + " " + subcommand + " --help").out;
    }
    for (std::string word; example >> word;)
      if (word.starts_with("--")) {
        EXPECT_THAT(help, HasSubstr("  " + word + " ")) << command;
      }
  }
  EXPECT_GT(commands, 15);
}

TEST(CommandLine, print_config_writes_the_template_to_stdout) {
  const ProgramResult result = run_program("print-config");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, scene_template());
  EXPECT_EQ(result.err, "");
}

}  // namespace gracilis
