#include <gracilis/io/run/recorded_corrections.hpp>
#include <gracilis/io/run/recorded_run.hpp>
#include <gracilis/io/run/run_folder.hpp>

#include "app/program.hpp"
#include "io/scene_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <set>
#include <sstream>

namespace gracilis {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Runs of the good scene: the capture pose (2 degrees), two frames to 0, ten to 10 degrees.
class RunChoices : public testing::Test {
 protected:
  RunChoices() { setenv("XDG_CACHE_HOME", folder.path("cache").c_str(), 1); }

  ProgramResult run(const std::string& more, const std::string& scene = good_scene(),
                    const std::string& out = "out") const {
    return run_program("run " + folder.write("scene.toml", scene).string() + " --out '" + folder.path(out).string() +
                       "' " + more + " < /dev/null");
  }
  RecordedRun recorded(const std::string& out = "out") const { return open_recorded_run(folder.path(out)); }

  SceneFolder folder;
};

TEST_F(RunChoices, a_run_says_what_comes_and_ends_with_what_it_found_and_what_to_do_next) {
  const ProgramResult result = run("", good_scene(), "my out");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err,
              HasSubstr("13 frames: 2 from the capture pose to the motion (the ramp), 11 of the motion; about"));
  EXPECT_THAT(result.err, HasSubstr("gates: "));
  EXPECT_THAT(result.err, HasSubstr("next: gracilis report '" + folder.path("my out").string() + "'"));
  EXPECT_THAT(result.err, Not(HasSubstr("triangles"))) << "what is of interest to few";
  EXPECT_THAT(run("--force --verbose").err, HasSubstr("muscle: 12 triangles"));
}

TEST_F(RunChoices, a_run_beyond_2_GB_needs_a_yes_where_nobody_can_be_asked) {
  const std::string huge = good_scene() + "step_deg = 0.001\n[fibers]\ncount = 1000\nsegments = 20\n";
  const ProgramResult refused = run("--layout surfaces", huge);
  EXPECT_EQ(refused.exit_code, 2) << refused.err;
  EXPECT_THAT(refused.err, HasSubstr("GB in "));
  EXPECT_THAT(refused.err, HasSubstr("--yes"));
  EXPECT_FALSE(std::filesystem::exists(folder.path("out")));
  EXPECT_EQ(run("--no-fibers --every 1000 --set method=skinning", huge).exit_code, 0);
}

TEST_F(RunChoices, without_pictures_everything_else_is_there) {
  ASSERT_EQ(run("", good_scene(), "all").exit_code, 0);
  const ProgramResult some = run("--no-pictures");
  ASSERT_EQ(some.exit_code, 0) << some.err;
  EXPECT_THAT(some.err, Not(HasSubstr("picture: ")));
  EXPECT_EQ(run_program("verify " + folder.path("out").string()).exit_code, 0);
  std::set<std::string> missing;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path("all")))
    if (const std::string name = entry.path().filename(); !std::filesystem::exists(folder.path("out") / name))
      missing.insert(name);
  EXPECT_EQ(missing, (std::set<std::string>{"plots", "preview.png"}));
}

TEST_F(RunChoices, every_nth_frame_is_recorded_of_a_run_that_computes_all) {
  ASSERT_EQ(run("", good_scene(), "all").exit_code, 0);
  ASSERT_EQ(run("--every 5").exit_code, 0);
  const RecordedRun all = recorded("all"), some = recorded();
  ASSERT_EQ(some.frame_count, 4);  // 0, 5, 10 and the last, 12
  for (const auto& [frame, of] : {std::pair{1, 5}, {2, 10}, {3, 12}}) {
    EXPECT_EQ(recorded_surface(some, "muscle", frame).vertices, recorded_surface(all, "muscle", of).vertices);
    EXPECT_EQ(some.times[static_cast<std::size_t>(frame)], all.times[static_cast<std::size_t>(of)]);
  }
}

TEST_F(RunChoices, a_thinned_run_resumes_as_it_was_begun) {
  ASSERT_EQ(run("--layout compact --every 3 --no-fibers --metrics light").exit_code, 0);
  const Points expected = recorded_surface(recorded(), "muscle", 4).vertices;
  for (int frame = 3; frame <= 4; ++frame) std::filesystem::remove(shapes_file(folder.path("out"), frame));
  const ProgramResult resumed = run("--resume");
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  const RecordedRun after = recorded();
  EXPECT_EQ(after.frame_count, 5);
  EXPECT_EQ(recorded_surface(after, "muscle", 4).vertices, expected);
  EXPECT_EQ(recorded_fibers(after, "muscle", 4).count(), 0);
  EXPECT_EQ(run_program("verify " + folder.path("out").string()).exit_code, 0);
  const auto as_json = nlohmann::json::parse(run_program("verify --json " + folder.path("out").string()).out);
  EXPECT_EQ(as_json.at("status"), "complete");
  EXPECT_TRUE(as_json.at("findings").empty());
}

TEST_F(RunChoices, corrections_lie_in_the_frames_whatever_the_layout_and_after_a_resume) {
  ASSERT_EQ(run("--corrections", good_scene(), "loose").exit_code, 0);
  ASSERT_EQ(run("--corrections --layout compact").exit_code, 0);
  std::filesystem::remove(shapes_file(folder.path("out"), 12));
  ASSERT_EQ(run("--resume").exit_code, 0);
  const RecordedRun loose = recorded("loose"), compact = recorded();
  EXPECT_TRUE(recorded_corrections(loose, "muscle", 0).empty());
  const Corrections told = recorded_corrections(loose, "muscle", 12);
  ASSERT_TRUE(told.contains("bone contact"));
  EXPECT_EQ(told.at("distance").cols(), 8) << "one per vertex";
  EXPECT_EQ(recorded_corrections(compact, "muscle", 12), told);
  EXPECT_EQ(run_program("verify " + folder.path("out").string()).exit_code, 0);
  const std::string picture = folder.path("arrows.png").string();
  EXPECT_EQ(run_program("render " + folder.path("loose").string() + " --arrows --frames 12 --out " + picture).exit_code,
            0);
  const ProgramResult beyond =
      run_program("render " + folder.path("loose").string() + " --arrows --frames 13 --out " + picture);
  EXPECT_EQ(beyond.exit_code, 2);
  EXPECT_THAT(beyond.err, HasSubstr("there is no frame 13"));
  const ProgramResult refused = run("--corrections --set method=skinning", good_scene(), "none");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("tells nothing of what its constraints move"));
}

TEST_F(RunChoices, without_ramp_frames_the_motion_follows_the_capture_pose) {
  ASSERT_EQ(run("--no-ramp").exit_code, 0);
  const RecordedRun some = recorded();
  EXPECT_EQ(some.frame_count, 12);
  EXPECT_EQ(some.first_motion_frame, 1);
  EXPECT_EQ(some.coordinate_values(0, 0), 2);
  EXPECT_EQ(some.coordinate_values(1, 0), 0);
}

TEST_F(RunChoices, what_is_not_measured_is_not_called_kept) {
  const ProgramResult none = run("--metrics none");
  ASSERT_EQ(none.exit_code, 0) << none.err;
  EXPECT_THAT(none.err, HasSubstr("gates: not measured: volume, stretch, depth in bones"));
  EXPECT_TRUE(std::isnan(measure_of(recorded(), "volume_ratio")(3, 0)));
  for (const std::string command : {"verify ", "inspect ", "report "})
    EXPECT_EQ(run_program(command + folder.path("out").string()).exit_code, 0) << command;

  const ProgramResult light = run("--force --metrics light");
  EXPECT_THAT(light.err, HasSubstr("not measured: depth in bones, depth in muscles, place, side of bones, slack"));
  EXPECT_NEAR(measure_of(recorded(), "volume_ratio")(3, 0), 1, 0.1);
  EXPECT_TRUE(std::isnan(measure_of(recorded(), "vertex_depth_beyond_rest_mm")(3, 0)));
  EXPECT_EQ(run_program("verify " + folder.path("out").string()).exit_code, 0);
}

}  // namespace
}  // namespace gracilis
