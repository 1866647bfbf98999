#include "app/program.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace gracilis {

TEST(ExportCommand, writes_the_lengths_of_a_run_as_opensim_s_function_based_paths) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "gracilis_export_command_test";
  std::filesystem::remove_all(folder);
  ASSERT_EQ(run_program("demo --out " + folder.string()).exit_code, 0);
  const ProgramResult result = run_program("export " + folder.string() + " --to osim-function");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  std::ifstream file(folder / "function_paths.osim");
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_NE(text.str().find("<FunctionBasedPath name=\"/forceset/iliacus_r\">"), std::string::npos) << text.str();
  EXPECT_NE(text.str().find("/jointset/hip_r/hip_flexion_r"), std::string::npos) << text.str();
  std::filesystem::remove_all(folder);
}

TEST(ExportCommand, a_format_that_it_does_not_know_is_a_usage_error) {
  EXPECT_EQ(run_program("export nowhere --to paper").exit_code, 2);
}

}  // namespace gracilis
