#include <gracilis/io/run/run_folder.hpp>

#include "app/program.hpp"
#include "io/scene_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace gracilis {
namespace {

using testing::HasSubstr;

class RunCommand : public testing::Test {
 protected:
  RunCommand() { setenv("XDG_CACHE_HOME", folder.path("cache").c_str(), 1); }

  ProgramResult run(const std::string& scene, const std::string& more = "") const {
    return run_program("run " + folder.write("scene.toml", scene).string() + " --no-pictures --out " + out() + " " +
                       more);
  }
  std::string out() const { return folder.path("out").string(); }

  nlohmann::json manifest() const { return nlohmann::json::parse(std::ifstream(folder.path("out/run.json"))); }

  std::string bytes(const std::string& name) const {
    std::stringstream text;
    text << std::ifstream(folder.path(name), std::ios::binary).rdbuf();
    return text.str();
  }

  SceneFolder folder;
};

std::string long_scene() { return good_scene() + "step_deg = 0.001\n"; }

TEST_F(RunCommand, a_run_leaves_a_complete_folder_and_prints_its_path_alone_to_stdout) {
  const ProgramResult result = run(good_scene());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, out() + "\n");
  // Capture pose (2 degrees), two steps to 0, ten to 10 degrees.
  EXPECT_TRUE(std::filesystem::exists(frame_file(out(), "muscle", 12)));
  EXPECT_TRUE(std::filesystem::exists(frame_file(out(), "femur", 12)));
  EXPECT_FALSE(std::filesystem::exists(frame_file(out(), "muscle", 13)));
  EXPECT_EQ(manifest()["status"], "complete");
  EXPECT_EQ(manifest()["frames"], 13);
  EXPECT_EQ(manifest()["preset"], "physical");
  EXPECT_THAT(manifest()["settings"].get<std::string>(), HasSubstr("\niterations = 30\n"));
  EXPECT_EQ(manifest()["inputs"].size(), 4u);
}

TEST_F(RunCommand, settings_from_the_command_line_reach_the_manifest) {
  EXPECT_EQ(run(good_scene(), "--set iterations=3 --set muscle.density=1000 --set preset=thesis-2024").exit_code, 0);
  EXPECT_EQ(manifest()["preset"], "thesis-2024");
  EXPECT_THAT(manifest()["settings"].get<std::string>(), HasSubstr("\niterations = 3\n"));
  EXPECT_THAT(manifest()["settings"].get<std::string>(), HasSubstr("\ndensity = 1000.0\n"));
}

TEST_F(RunCommand, guessed_attachments_are_marked_in_the_manifest) {
  EXPECT_EQ(run(with(good_scene(), "bone = \"femur\"", "bone = \"femur\"\nguessed = true")).exit_code, 0);
  EXPECT_EQ(manifest()["guessed"], nlohmann::json::array({"muscle bottom"}));
}

TEST_F(RunCommand, the_results_do_not_depend_on_the_number_of_threads) {
  EXPECT_EQ(run(good_scene(), "--threads 1").exit_code, 0);
  const std::string one = bytes("out/frames/muscle_0012.vtp");
  EXPECT_EQ(run(good_scene(), "--threads 2 --force").exit_code, 0);
  EXPECT_FALSE(one.empty());
  EXPECT_TRUE(one == bytes("out/frames/muscle_0012.vtp"));
}

TEST_F(RunCommand, another_run_in_the_folder_is_not_overwritten_unless_asked) {
  EXPECT_EQ(run(good_scene()).exit_code, 0);
  const ProgramResult refused = run(good_scene());
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("holds a run already (--resume goes on with it, --force replaces it"));
  EXPECT_EQ(run(good_scene(), "--force").exit_code, 0);
  EXPECT_EQ(run(good_scene(), "--force --resume").exit_code, 2) << "one or the other";
}

TEST_F(RunCommand, an_interrupted_run_exits_with_130_and_resumes_to_the_same_bits) {
  EXPECT_EQ(run(good_scene()).exit_code, 0);
  const std::string expected = bytes("out/frames/muscle_0012.vtp");

  // The signal comes once the run has got somewhere.
  const ProgramResult stopped =
      run_program("run " + folder.write("scene.toml", long_scene()).string() + " --layout surfaces --force --out " +
                  out() + " 2>" + folder.path("log").string() + " & pid=$!; while kill -0 $pid && [ ! -e " +
                  frame_file(out(), "muscle", 20).string() + " ]; do sleep 0.05; done; kill -INT $pid; wait $pid");
  EXPECT_EQ(stopped.exit_code, 130);
  EXPECT_EQ(stopped.out, "");
  EXPECT_THAT(bytes("log"), HasSubstr("--resume goes on from there"));
  EXPECT_EQ(manifest()["status"], "interrupted");
  EXPECT_GT(manifest()["frames"], 20);

  // Cut the complete run short by hand, then go on.
  EXPECT_EQ(run(good_scene(), "--force").exit_code, 0);
  for (int frame = 8; frame <= 12; ++frame) std::filesystem::remove(frame_file(out(), "muscle", frame));
  const ProgramResult resumed = run(good_scene(), "--resume");
  EXPECT_EQ(resumed.exit_code, 0);
  EXPECT_THAT(resumed.err, HasSubstr("going on after frame 5")) << "where contact is searched anew";
  EXPECT_TRUE(bytes("out/frames/muscle_0012.vtp") == expected);
  EXPECT_EQ(manifest()["frames"], 13);
}

TEST_F(RunCommand, what_is_said_of_a_resumed_run_is_of_all_its_frames) {
  ASSERT_EQ(run(good_scene(), "--layout surfaces").exit_code, 0);
  // As if frame 3 had lost a tenth of its volume, and the run had been stopped after frame 7.
  const std::string measures = bytes("out/measures.csv");
  const std::size_t row = measures.find("\n3,"), begin = measures.find(",muscle,", row) + 8;
  folder.write("out/measures.csv", measures.substr(0, begin) + "0.9" + measures.substr(measures.find(',', begin)));
  for (int frame = 8; frame <= 12; ++frame) std::filesystem::remove(frame_file(out(), "muscle", frame));
  const ProgramResult resumed = run(good_scene(), "--resume --strict");
  EXPECT_EQ(resumed.exit_code, 5);
  EXPECT_THAT(resumed.err, HasSubstr("gates: missed by 1 of 1 muscles, in 1 of 13 frames"));
  EXPECT_THAT(resumed.err, HasSubstr("worst: frame 3, muscle: volume 90.00 % of rest"));
  EXPECT_THAT(manifest()["warnings"].dump(), HasSubstr("first in frame 3"));
  EXPECT_EQ(run(good_scene(), "--resume --strict").exit_code, 5) << "nor does a complete one forget";
}

TEST_F(RunCommand, SIGTERM_ends_a_run_within_a_second_in_the_middle_of_a_frame) {
  // A frame of as many iterations would take hours.
  const std::string command = "run " + folder.write("scene.toml", good_scene()).string() + " --set iterations=100000";
  const ProgramResult stopped = run_program(
      command + " --out " + out() + " 2>" + folder.path("log").string() + " & pid=$!; while kill -0 $pid && [ ! -e " +
      frame_file(out(), "muscle", 0).string() +
      " ]; do sleep 0.05; done; sleep 0.5; kill -TERM $pid; sleep 1; kill -0 $pid 2>/dev/null && echo late; wait $pid");
  EXPECT_EQ(stopped.exit_code, 130);
  EXPECT_EQ(stopped.out, "");
  EXPECT_EQ(manifest()["status"], "interrupted");
  EXPECT_EQ(run_program("inspect " + out()).exit_code, 0);
  EXPECT_EQ(run(good_scene(), "--force").exit_code, 0);
  EXPECT_EQ(manifest()["frames"], 13);
}

TEST_F(RunCommand, a_wrong_scene_exits_with_2_lists_every_problem_and_writes_nothing) {
  const ProgramResult result = run(good_scene() + "stepp = 1\n[settings]\niterations = 0\n");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, HasSubstr("error: " + folder.path("scene.toml").string() + ":39:1: unknown key 'stepp'"));
  EXPECT_THAT(result.err, HasSubstr("'iterations' must be an integer from 1 to 100000"));
  EXPECT_FALSE(std::filesystem::exists(out()));
}

TEST_F(RunCommand, unreadable_input_exits_with_3_and_writes_nothing) {
  folder.write("pelvis.ply", "ply\nformat ascii 1.0\n");
  const ProgramResult broken = run(good_scene());
  EXPECT_EQ(broken.exit_code, 3);
  EXPECT_THAT(broken.err, HasSubstr("pelvis.ply"));
  EXPECT_FALSE(std::filesystem::exists(out()));
  EXPECT_EQ(run_program("run " + folder.path("none.toml").string()).exit_code, 3);
  const ProgramResult unit =
      run(with(good_scene(), "file = \"muscle.ply\"\nunit = \"mm\"", "file = \"muscle.ply\"\nunit = \"m\""));
  EXPECT_EQ(unit.exit_code, 3);
  EXPECT_FALSE(std::filesystem::exists(out()));
}

TEST_F(RunCommand, an_unknown_muscle_exits_with_2_and_suggests_the_nearest) {
  const ProgramResult result = run(good_scene(), "--only muscel");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("there is no muscle 'muscel' (did you mean 'muscle'?)"));
}

TEST_F(RunCommand, no_escape_codes_reach_a_file) {
  const ProgramResult result = run(good_scene());
  EXPECT_EQ(result.err.find('\033'), std::string::npos);
  EXPECT_EQ(result.err.find('\r'), std::string::npos);
}

}  // namespace
}  // namespace gracilis
