#include "app/program.hpp"
#include "calibrate/bent_box.hpp"
#include "study/study_scenes.hpp"

#include <gracilis/calibrate/observation.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/tables/arm_reference.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdlib>
#include <thread>

namespace gracilis {

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// A scene, what it has with a tie_length of 0.012 m, and what aims at that.
struct CalibrationFolder : BentFolder {
  explicit CalibrationFolder(const std::string& targets = aim_at_arms) {
    write("targets.toml", targets);
    SceneOptions options;
    options.set = {"tie_length=0.012"};
    CalibrationTarget arms;
    arms.coordinate = "flexion";
    arms.parts = {{"front", "", {}, {}, nullptr}};
    for (const Real angle : {-40, -20, 0, 20, 40}) arms.parts[0].at.push_back(radians(angle));
    CalibrationTarget lengths = arms;
    lengths.kind = TargetKind::lengths;
    const std::atomic<bool> never = false;
    const Observation seen = observe(read_scene(path("bent.toml"), options), {arms, lengths}, never);
    write("arms.csv", "muscle,angle_deg,moment_arm_m\n" + rows(arms.parts[0].at, seen[0][0]));
    write("lengths.csv", "muscle,angle_deg,length_m\n" + rows(arms.parts[0].at, seen[1][0]));
  }

  static std::string rows(const std::vector<Real>& angles, const std::vector<Real>& values) {
    std::string text;
    for (std::size_t i = 0; i < angles.size(); ++i)
      text += "front," + to_text(degrees(angles[i])) + "," + to_text(values[i]) + "\n";
    return text;
  }

  std::string command(const std::string& out, const std::string& more = "") const {
    return "calibrate " + path("bent.toml").string() + " --targets " + path("targets.toml").string() + " --out " +
           path(out).string() + " " + more;
  }
};

/// What stands in a scene's or a table's line that begins so.
double number_after(const std::string& text, const std::string& begin) {
  const std::size_t found = text.find(begin);
  return found == std::string::npos ? -1 : std::atof(text.c_str() + found + begin.size());
}

}  // namespace

TEST(CalibrateCommand, it_finds_what_made_the_targets_and_improves_lengths_that_it_has_not_seen) {
  const CalibrationFolder folder(aim_at_arms + R"([[targets]]
name = "lengths"
kind = "lengths"
file = "lengths.csv"
coordinate = "flexion"
muscles = ["front"]
held_out = true
)");
  const ProgramResult result = run_program(folder.command("found"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string toml = read_text(folder.path("found/calibrated.toml"));
  EXPECT_NEAR(number_after(toml, "tie_length = "), 0.012, 0.02 * 0.012);
  EXPECT_THAT(toml, HasSubstr("[settings]\n"));
  EXPECT_THAT(result.out, HasSubstr("lengths, held out: "));
  const std::string said = result.out.substr(result.out.find("held out: "));
  EXPECT_LT(number_after(said, "before, "), 0.1 * number_after(said, "held out: ")) << said;

  // Nothing is evaluated twice.
  const nlohmann::json told = nlohmann::json::parse(run_program(folder.command("found", "--json")).out);
  EXPECT_EQ(told.at("parameters").at(0).at("key"), "tie_length");
  EXPECT_NEAR(told.at("parameters").at(0).at("value").get<double>(), number_after(toml, "tie_length = "), 1e-12);
  const nlohmann::json& lengths = told.at("targets").at(1);
  EXPECT_EQ(lengths.at("held_out"), true);
  EXPECT_LT(lengths.at("rms_after").get<double>(), 0.1 * lengths.at("rms_before").get<double>());

  const std::string page = read_text(folder.path("found/report.html"));
  for (const char* text : {"Held out", "tie_length", "Standard error", "<svg", "calibrated_scene.toml"})
    EXPECT_THAT(page, HasSubstr(text));
  EXPECT_THAT(page, Not(HasSubstr("{{")));

  // What it found is a scene that runs, and gives the arms aimed at.
  const ProgramResult again =
      run_program("rom " + folder.path("found/calibrated_scene.toml").string() +
                  " --coord flexion=-40:40:20 --metrics none --no-ramp --out " + folder.path("again").string());
  ASSERT_EQ(again.exit_code, 0) << again.err;
  const ArmCurve aim = read_arm_reference(folder.path("arms.csv")).at(0),
                 arms = read_arm_reference(folder.path("again/moment_arms.sto"), "flexion").at(0);
  ASSERT_EQ(arms.arms.size(), 5u);
  for (std::size_t i = 0; i < arms.arms.size(); ++i) EXPECT_NEAR(arms.arms[i], aim.arms[i], 1e-4) << arms.angles[i];
}

TEST(CalibrateCommand, killed_and_started_again_it_has_the_same_history_and_answer_by_any_number_of_processes) {
  const CalibrationFolder folder;
  ASSERT_EQ(run_program(folder.command("whole", "--jobs 1")).exit_code, 0);
  const std::string history = read_text(folder.path("whole/evaluations.csv"));
  ASSERT_GT(std::count(history.begin(), history.end(), '\n'), 6);
  int kills = 0;
  for (int attempt = 0; attempt < 40; ++attempt) {
    const pid_t child = start_program({"calibrate", folder.path("bent.toml"), "--targets", folder.path("targets.toml"),
                                       "--out", folder.path("killed"), "--jobs", "2"});
    std::this_thread::sleep_for(std::chrono::milliseconds(300 + 60 * attempt));
    kill(child, SIGKILL);
    if (const int code = end_of(child); code >= 0) {
      EXPECT_EQ(code, 0);
      break;
    }
    ++kills;
  }
  EXPECT_GE(kills, 1);
  const ProgramResult end = run_program(folder.command("killed", "--jobs 2"));
  ASSERT_EQ(end.exit_code, 0) << end.err;
  EXPECT_THAT(end.err, Not(HasSubstr("evaluation 1:"))) << "all is known";
  EXPECT_EQ(read_text(folder.path("killed/evaluations.csv")), history);
  for (const char* file : {"calibrated.toml", "parameters.csv", "fit.csv"})
    EXPECT_EQ(read_text(folder.path("killed") / file), read_text(folder.path("whole") / file)) << file;
}

TEST(CalibrateCommand, a_folder_of_another_calibration_is_kept_unless_force_says_otherwise) {
  const CalibrationFolder folder(aim_at_arms + "[search]\nevaluations = 1\n");
  ASSERT_EQ(run_program(folder.command("out")).exit_code, 0);
  const ProgramResult other = run_program(folder.command("out", "--set bone_gap=0.003"));
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err, HasSubstr("holds a calibration of another scene"));
  folder.write("targets.toml", aim_at_arms + "[search]\nevaluations = 2\nsamples = 1\n");
  const ProgramResult more = run_program(folder.command("out"));
  EXPECT_EQ(more.exit_code, 0) << "another search goes on with what is known\n" << more.err;
  EXPECT_THAT(more.err, Not(HasSubstr("evaluation 1:")));
  EXPECT_EQ(run_program(folder.command("out", "--set bone_gap=0.003 --force")).exit_code, 0);
  EXPECT_THAT(read_text(folder.path("out/calibrated.toml")), HasSubstr("bone_gap = 0.003"));
}

TEST(CalibrateCommand, volumes_and_shapes_are_aimed_at_by_nlopt_too) {
  // The muscle's own surface as it is: shape and volume are met at once, and nothing can be better.
  const CalibrationFolder folder(R"([[targets]]
kind = "shapes"
muscle = "front"
file = "front.ply"
unit = "mm"
[[targets]]
kind = "volumes"
volumes_cm3 = { front = 2.88 }
[[parameters]]
key = "tie_length"
bounds = [0.004, 0.1]
[[parameters]]
key = "front.bone_gap"
bounds = [0, 0.01]
[search]
method = "bobyqa"
evaluations = 6
)");
  folder.write("front.ply", R"(ply
format ascii 1.0
element vertex 8
property float x
property float y
property float z
element face 6
property list uchar int vertex_indices
end_header
-4 -13 -30
4 -13 -30
-4 -7 -30
4 -7 -30
-4 -13 30
4 -13 30
-4 -7 30
4 -7 30
4 0 2 3 1
4 4 5 7 6
4 0 1 5 4
4 2 6 7 3
4 0 4 6 2
4 1 3 7 5
)");
  const ProgramResult result = run_program(folder.command("out"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("shapes 1: "));
  EXPECT_LT(number_after(result.out, "shapes 1: "), 0.001) << result.out;
  EXPECT_LT(number_after(result.out, "volumes 2: "), 0.001) << result.out;
}

TEST(CalibrateCommand, what_does_not_fit_the_scene_is_one_message_each_and_nothing_is_evaluated) {
  const CalibrationFolder folder(R"([[targets]]
kind = "lengths"
file = "lengths.csv"
coordinate = "flexion"
pose = { rotation = 3 }
[[parameters]]
key = "tie_lenght"
bounds = [0.004, 0.1]
[[parameters]]
key = "back.tie_length"
bounds = [0.004, 0.1]
[[parameters]]
key = "bone_gap"
bounds = [0.001, 1]
[[parameters]]
key = "iterations"
bounds = [1, 50]
[[parameters]]
key = "support_length"
bounds = [0.01, 0.02]
)");
  const ProgramResult result = run_program(folder.command("out"));
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 6) << result.err;
  for (const char* text : {"targets.toml:1:1: the scene has no coordinate 'rotation'", "did you mean 'tie_length'?",
                           "the scene has no muscle 'back'", "it must be a number from 0 to 0.03 m",
                           "'iterations' is a whole number", "the scene has support_length = 0.007, outside"})
    EXPECT_THAT(result.err, HasSubstr(text));
  EXPECT_FALSE(fs::exists(folder.path("out/evaluations")));
}

}  // namespace gracilis
