#include <gracilis/io/scene/scene_template.hpp>

#include "app/program.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
  for (const char* arguments : {"", "--no-such-option", "no-such-command", "print-config extra"}) {
    const ProgramResult result = run_program(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_EQ(result.out, "") << arguments;
    EXPECT_NE(result.err, "") << arguments;
  }
}

TEST(CommandLine, print_config_writes_the_template_to_stdout) {
  const ProgramResult result = run_program("print-config");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, scene_template());
  EXPECT_EQ(result.err, "");
}

}  // namespace gracilis
