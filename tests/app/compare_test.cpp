#include "app/program.hpp"
#include "io/scene_folder.hpp"

#include <gracilis/io/input_file.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <sstream>
#include <vector>

namespace gracilis {

namespace {

using testing::HasSubstr;
using testing::Not;

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, at);) parts.push_back(part);
  return parts;
}

/// The table of numbers: by method and muscle, then by column.
std::map<std::string, std::map<std::string, std::string>> rows_of(const std::filesystem::path& file) {
  const std::vector<std::string> lines = split(read_text(file), '\n');
  const std::vector<std::string> header = split(lines.at(0), ',');
  std::map<std::string, std::map<std::string, std::string>> rows;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> cells = split(lines[i], ',');
    for (std::size_t c = 0; c < cells.size(); ++c) rows[cells[0] + " " + cells[1]][header.at(c)] = cells[c];
  }
  return rows;
}

}  // namespace

TEST(CompareCommand, runs_the_builtin_hip_by_several_methods_and_shows_them_side_by_side) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "gracilis_compare_test";
  std::filesystem::remove_all(folder);
  const ProgramResult result = run_program(
      "compare demo --flexion 4 --only iliacus_r,adductor_brevis_r "
      "--methods xpbd,tissue,strings,pbd,pbd-2020,arap,rbf,mass-spring,skinning,cylinder --frames 0,4 --out " +
      folder.string());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, (folder / "comparison.html").string() + "\n" + (folder / "comparison.csv").string() + "\n");
  auto rows = rows_of(folder / "comparison.csv");
  EXPECT_EQ(rows.size(), 20u);
  for (const std::string method : {"xpbd", "pbd", "pbd-2020", "arap", "rbf"}) {
    EXPECT_LT(std::stod(rows.at(method + " iliacus_r").at("volume_error_percent")), 0.5) << method;
    EXPECT_EQ(rows.at(method + " iliacus_r").at("frames"), "5");
    EXPECT_EQ(rows.at(method + " iliacus_r").at("self_cuts"), "0");
    EXPECT_NEAR(std::stod(rows.at(method + " iliacus_r").at("fiber_length_mm")), 162, 5) << method;
  }
  EXPECT_NEAR(std::stod(rows.at("mass-spring iliacus_r").at("fiber_length_mm")), 162, 5) << "it knows no volume";
  EXPECT_GT(std::stod(rows.at("skinning iliacus_r").at("volume_error_percent")), 0.5) << "it knows no volume";
  const std::string page = read_text(folder / "comparison.html");
  for (const std::string text : {"adductor_brevis_r", "<td>pbd-2020</td>", "moment arm"})
    EXPECT_THAT(page, HasSubstr(text));
  EXPECT_THAT(read_text(folder / "pbd" / "run.json"), HasSubstr("method = \\\"pbd\\\""));

  const ProgramResult refused = run_program("compare demo --flexion 4 --methods pbd --out " + folder.string());
  EXPECT_EQ(refused.exit_code, 2) << "there is a run in the folder";
  std::filesystem::remove_all(folder);
}

TEST(CompareCommand, an_unknown_method_is_a_usage_error_before_anything_runs) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "gracilis_compare_names_test";
  std::filesystem::remove_all(folder);
  const ProgramResult result = run_program("compare demo --methods xpd,arap,arap --out " + folder.string());
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("there is no method or preset 'xpd' (did you mean 'xpbd'?)"));
  EXPECT_THAT(result.err, HasSubstr("'arap' is there twice"));
  EXPECT_FALSE(std::filesystem::exists(folder));
}

TEST(CompareCommand, a_method_whose_settings_do_not_fit_together_is_told_before_anything_runs) {
  const ProgramResult result = run_program(
      "compare demo --set method=mass-spring --set smallest_step=0.5 --methods skinning,mass-spring --out /nowhere");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("'smallest_step' is above 'verlet_step'"));
}

TEST(CompareCommand, a_frame_that_is_not_there_is_a_usage_error_before_anything_runs) {
  const ProgramResult result = run_program("compare demo --flexion 4 --methods skinning --frames 0,9 --out /nowhere");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("there is no frame 9"));
  EXPECT_THAT(result.err, HasSubstr("frames 0 to 4"));
}

TEST(CompareCommand, runs_beyond_2_GB_together_need_a_yes_and_name_no_option_that_there_is_not) {
  const SceneFolder folder;
  // 1.5 GB a run.
  const std::string scene = good_scene() + "step_deg = 0.001\n[fibers]\ncount = 10000\nsegments = 20\n";
  const ProgramResult refused =
      run_program("compare '" + folder.write("scene.toml", scene).string() + "' --methods skinning,pbd --out '" +
                  folder.path("out").string() + "' < /dev/null");
  EXPECT_EQ(refused.exit_code, 2) << refused.err;
  EXPECT_THAT(refused.err, HasSubstr("GB in "));
  EXPECT_THAT(refused.err, HasSubstr("--yes"));
  for (const std::string missing : {"--every", "--no-fibers"}) EXPECT_THAT(refused.err, Not(HasSubstr(missing)));
  EXPECT_FALSE(std::filesystem::exists(folder.path("out")));
  EXPECT_THAT(run_program("compare --help").out, HasSubstr("--yes"));
}

TEST(CompareCommand, help_says_what_exit_codes_mean) {
  const ProgramResult result = run_program("compare --help");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("Exit codes:"));
}

}  // namespace gracilis
