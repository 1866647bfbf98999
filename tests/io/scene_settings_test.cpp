#include <gracilis/io/scene/scene_reader.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/methods/xpbd/settings.hpp>

#include "io/scene_reader_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis {
namespace {

using testing::HasSubstr;

}  // namespace

TEST_F(SceneReader, settings_are_global_and_overridden_per_muscle) {
  std::string text =
      with(good_scene(), "[[muscles.attachments]]", "[muscles.settings]\niterations = 7\n[[muscles.attachments]]");
  text += "[settings]\niterations = 5\ndensity = 1000\n";
  const Scene scene = read(text).scene;
  const XpbdSettings settings = xpbd_settings(scene, scene.muscles[0]);
  EXPECT_EQ(settings.iterations, 7);
  EXPECT_EQ(settings.density, 1000);
}

TEST_F(SceneReader, the_command_line_sets_globally_and_per_muscle) {
  const LoadedScene loaded = read(good_scene() + "[settings]\niterations = 5\n",
                                  {"",
                                   {"iterations=50", "muscle.density=999", "time_mode=dynamic", "gravity=[0, 0, -9.81]",
                                    "distance_field.cell_size=0.002", "sequence.hold_frames=3"},
                                   {}});
  EXPECT_EQ(xpbd_settings(loaded.scene, loaded.scene.muscles[0]).iterations, 50);
  EXPECT_EQ(xpbd_settings(loaded.scene, loaded.scene.muscles[0]).density, 999);
  EXPECT_EQ(xpbd_settings(loaded.scene, loaded.scene.muscles[0]).time_mode, TimeMode::dynamic);
  EXPECT_EQ(xpbd_settings(loaded.scene, loaded.scene.muscles[0]).gravity.z(), -9.81);
  EXPECT_EQ(loaded.scene.distance_fields.cell_size, 0.002);
  EXPECT_EQ(loaded.scene.sequence.hold_frames, 3);
}

TEST_F(SceneReader, the_command_line_sets_one_key_of_the_motion) {
  const Motion motion = read(good_scene(), {"", {"motion.step_deg=2.5"}, {}}).scene.motion;
  ASSERT_EQ(motion.times.size(), 5u);
  EXPECT_NEAR(motion.values(1, 0), radians(2.5), 1e-12);
  EXPECT_NEAR(motion.values(4, 0), radians(10), 1e-12);
}

TEST_F(SceneReader, a_preset_from_the_command_line_sets_aside_the_files_settings_and_says_so) {
  const LoadedScene loaded =
      read(good_scene() + "[settings]\niterations = 5\n", {"", {"density=999", "preset=thesis-2024"}, {}});
  EXPECT_EQ(loaded.preset, "thesis-2024");
  EXPECT_EQ(xpbd_settings(loaded.scene, loaded.scene.muscles[0]).iterations, 70);
  EXPECT_EQ(xpbd_settings(loaded.scene, loaded.scene.muscles[0]).density, 999)
      << "what the command line sets itself stays";
  EXPECT_EQ(loaded.scene.distance_fields.resolution, 128);
  EXPECT_THAT(loaded.warnings, testing::Contains(HasSubstr("'thesis-2024' sets aside the settings")));
}

TEST_F(SceneReader, a_preset_brings_its_method_unless_one_is_named) {
  // Keys of the top come before all tables.
  const auto on_top = [](const std::string& line) { return with(good_scene(), "schema = 1", "schema = 1\n" + line); };
  EXPECT_EQ(read(on_top("preset = \"pbd-2020\"")).scene.method.settings, find_preset("pbd-2020")->method.settings);
  EXPECT_EQ(read(on_top("preset = \"pbd-2020\"\nmethod = \"arap\"")).scene.method.name, "arap");
  const LoadedScene over = read(on_top("method = \"skinning\""), {"", {"preset=pbd-2020"}, {}});
  EXPECT_EQ(over.scene.method.name, "pbd") << "the file's method goes with its settings";
  EXPECT_EQ(read(good_scene(), {"", {"preset=pbd-2020", "method=arap"}, {}}).scene.method.name, "arap");
}

TEST_F(SceneReader, a_scene_runs_by_another_method_too_which_says_what_it_does_not_have) {
  const LoadedScene loaded =
      read(good_scene() + "[settings]\niterations = 5\ntendon_length = 0.01\n", {"", {"method=skinning"}, {}});
  EXPECT_EQ(loaded.scene.method.name, "skinning");
  EXPECT_EQ(loaded.scene.method.settings, (SettingValues{{"tendon_length", 0.01}}));
  EXPECT_THAT(loaded.warnings, testing::Contains(HasSubstr("'skinning' has no setting 'iterations'")));
  EXPECT_THAT(problems(good_scene() + "[settings]\niterations = 0\n", {"", {"method=skinning"}, {}}),
              HasSubstr("'iterations' must be an integer"));
  EXPECT_THAT(problems(good_scene(), {"", {"method=skining"}, {}}), HasSubstr("there is no method 'skining'"));
}

TEST_F(SceneReader, what_muscles_are_solved_with_together_is_the_scenes) {
  const std::string text =
      with(good_scene(), "[[muscles.attachments]]", "[muscles.settings]\nsubsteps = 3\n[[muscles.attachments]]");
  const LoadedScene loaded = read(text);
  EXPECT_EQ(loaded.scene.method.settings, (SettingValues{{"substeps", 3}}));
  EXPECT_TRUE(loaded.scene.muscles[0].settings.empty());
  EXPECT_THAT(loaded.warnings, testing::Contains(HasSubstr("'substeps' holds for all muscles together")));
}

TEST_F(SceneReader, an_included_file_is_the_base_that_the_file_builds_on) {
  folder.write("base.toml", good_scene() + "[settings]\niterations = 5\ndensity = 1000\n");
  const LoadedScene loaded = read(R"(schema = 1
include = "base.toml"
name = "variant"
[settings]
iterations = 6
[[muscles]]
name = "muscle"
settings.hinge_limit = 0.1
[motion]
coordinates = ["flexion"]
key_poses_deg = [[1]]
)");
  EXPECT_EQ(loaded.scene.name, "variant");
  ASSERT_EQ(loaded.scene.muscles.size(), 1u);
  EXPECT_EQ(xpbd_settings(loaded.scene, loaded.scene.muscles[0]).iterations, 6);
  EXPECT_EQ(xpbd_settings(loaded.scene, loaded.scene.muscles[0]).density, 1000);
  EXPECT_EQ(xpbd_settings(loaded.scene, loaded.scene.muscles[0]).dihedral_limit, 0.1);
  EXPECT_EQ(loaded.scene.motion.times.size(), 1u);
  EXPECT_EQ(loaded.inputs[1].filename(), "base.toml");
}

TEST_F(SceneReader, only_keeps_the_named_muscles) {
  folder.write_box("second.ply", 11, 29);
  std::string second = good_scene();
  second = second.substr(second.find("[[muscles]]"));
  second =
      with(with(second.substr(0, second.find("[motion]")), "\"muscle\"", "\"second\""), "muscle.ply", "second.ply");
  EXPECT_EQ(read(good_scene() + second).scene.muscles.size(), 2u);
  const Scene scene = read(good_scene() + second, {"", {}, {"second"}}).scene;
  ASSERT_EQ(scene.muscles.size(), 1u);
  EXPECT_EQ(scene.muscles[0].name, "second");
}

}  // namespace gracilis
