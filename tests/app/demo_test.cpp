#include "app/program.hpp"

#include <gracilis/io/input_file.hpp>
#include <gracilis/io/mesh/mesh_reader_vtp.hpp>
#include <gracilis/io/run/run_layout.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace gracilis {

TEST(DemoCommand, flexes_the_elbow_and_meets_the_quality_gates) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "gracilis_demo_command_test";
  std::filesystem::remove_all(folder);
  const ProgramResult result = run_program("demo elbow --flexion 6 --strict --out " + folder.string());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(std::filesystem::exists(frame_file(folder, "biceps_brachii_long_r", 3)));
  EXPECT_FALSE(std::filesystem::exists(frame_file(folder, "biceps_brachii_long_r", 4)));
  std::filesystem::remove_all(folder);
}

TEST(DemoCommand, takes_the_settings_that_run_takes) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "gracilis_demo_settings_test";
  std::filesystem::remove_all(folder);
  const ProgramResult result = run_program(
      "demo --flexion 3 --layout compact --set method=skinning --set tendon_length=0.01 --set sequence.hold_frames=2 "
      "--only iliacus_r,adductor_brevis_r --threads 1 --out " +
      folder.string());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(std::filesystem::exists(shapes_file(folder, 5))) << "three degrees and two frames more";
  EXPECT_TRUE(VtpFile(shapes_file(folder, 5)).has("iliacus_r"));
  EXPECT_FALSE(VtpFile(shapes_file(folder, 5)).has("gluteus_maximus_r"));
  const std::string manifest = read_text(folder / "run.json");
  EXPECT_THAT(manifest, testing::HasSubstr("method = \\\"skinning\\\""));
  EXPECT_THAT(manifest, testing::HasSubstr("tendon_length = 0.01"));
  EXPECT_THAT(manifest, testing::Not(testing::HasSubstr("iterations"))) << "skinning has none";
  std::filesystem::remove_all(folder);
}

TEST(DemoCommand, a_preset_brings_its_method) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "gracilis_demo_preset_test";
  std::filesystem::remove_all(folder);
  const ProgramResult result =
      run_program("demo --flexion 1 --preset pbd-2020 --only iliacus_r --out " + folder.string());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const std::string manifest = read_text(folder / "run.json");
  EXPECT_THAT(manifest, testing::HasSubstr("method = \\\"pbd\\\""));
  EXPECT_THAT(manifest, testing::HasSubstr("\"preset\": \"pbd-2020\""));
  std::filesystem::remove_all(folder);
}

TEST(DemoCommand, a_wrong_setting_is_a_usage_error_that_names_it) {
  const ProgramResult result = run_program("demo --set iteration=5 --set motion.step_deg=1 --only iliacs_r");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, testing::HasSubstr("unknown key 'iteration'"));
  EXPECT_THAT(result.err, testing::HasSubstr("unknown key 'motion'"));
  EXPECT_THAT(result.err, testing::HasSubstr("there is no muscle 'iliacs_r'"));
}

TEST(DemoCommand, a_scene_that_is_not_built_in_is_a_usage_error) { EXPECT_EQ(run_program("demo knee").exit_code, 2); }

}  // namespace gracilis
