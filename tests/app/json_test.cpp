#include "app/program.hpp"
#include "io/scene_folder.hpp"
#include "opensim/model_texts.hpp"
#include "study/study_scenes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gracilis {
namespace {

using Json = nlohmann::json;
using opensim::muscle;
using opensim::pendulum;
using opensim::point;
using testing::HasSubstr;

/// What the program tells programs; nothing else may be on its standard output.
Json told(const std::string& arguments, int code = 0) {
  const ProgramResult result = run_program(arguments + " --json");
  EXPECT_EQ(result.exit_code, code) << result.err;
  EXPECT_TRUE(Json::accept(result.out)) << result.out;
  return Json::parse(result.out, nullptr, false);
}

const std::string from_ground_to_rod = point("/ground", "0.1 0.1 0") + point("/bodyset/rod", "0.05 -0.3 0");

std::string model_in(const TestFolder& folder) {
  return folder.write("tiny.osim", pendulum(muscle("m", from_ground_to_rod))).string();
}

TEST(Json, of_a_run_tells_its_frames_its_gates_and_what_to_look_at) {
  const SceneFolder folder;
  const std::string out = folder.path("out").string();
  const Json run = told("run " + folder.write("scene.toml", good_scene()).string() + " --no-pictures --out " + out);
  EXPECT_EQ(run.at("folder"), out);
  EXPECT_EQ(run.at("status"), "complete");
  EXPECT_EQ(run.at("frames"), 13);
  EXPECT_GT(run.at("seconds"), 0);
  EXPECT_EQ(run.at("gates").at("of_frames"), 13);
  EXPECT_TRUE(run.at("picture").is_null());
  EXPECT_EQ(run.at("next"), "gracilis report " + out);
}

TEST(Json, of_a_run_names_the_muscles_that_miss_gates_and_the_worst_frame) {
  const TestFolder folder;
  const Json demo = told("demo --flexion 60 --step 20 --set method=skinning --no-pictures --strict --out " +
                             (folder.path() / "hip").string(),
                         5);
  const Json& gates = demo.at("gates");
  EXPECT_EQ(gates.at("met"), false);
  EXPECT_EQ(gates.at("frames"), 3);
  EXPECT_FALSE(gates.at("missed_by").empty());
  EXPECT_GT(gates.at("worst").at("frame"), 0);
  EXPECT_THAT(gates.at("worst").at("muscle").get<std::string>(), testing::EndsWith("_r"));
}

TEST(Json, of_a_comparison_has_its_table) {
  const TestFolder folder;
  const Json compared =
      told("compare demo --flexion 2 --methods skinning,arap --out " + (folder.path() / "methods").string());
  EXPECT_EQ(compared.at("rows").size(), 12u);
  EXPECT_EQ(compared.at("rows")[0].at("method"), "skinning");
  EXPECT_GT(compared.at("rows")[0].at("volume_error_percent"), 0);
  EXPECT_EQ(compared.at("methods")[1].at("run"), (folder.path() / "methods/arap").string());
  EXPECT_TRUE(std::filesystem::exists(compared.at("page").get<std::string>()));
}

TEST(Json, of_paths_names_the_files_and_whose_lengths_differ) {
  const TestFolder folder;
  const Json paths = told("paths " + model_in(folder) + " --coord swing=-10:20:5 --out " + folder.path().string());
  EXPECT_EQ(paths.at("rows"), 7);
  EXPECT_EQ(paths.at("over"), "swing");
  EXPECT_EQ(paths.at("files").size(), 7u) << "lengths and arms as .sto, .csv and .svg, and the coordinate";
  for (const std::string file : paths.at("files")) EXPECT_TRUE(std::filesystem::exists(file)) << file;
  EXPECT_TRUE(paths.at("lengths_apart").empty());
}

TEST(Json, of_static_optimization_tells_when_muscles_are_too_weak) {
  const TestFolder folder;
  const auto model = folder.write(
      "tiny.osim", pendulum("<CoordinateActuator name=\"motor\"><coordinate>swing</coordinate><optimal_force>10"
                            "</optimal_force><max_control>0.1</max_control></CoordinateActuator>"));
  std::string still = "still\nversion=1\nnRows=8\nnColumns=2\ninDegrees=yes\nendheader\ntime\tswing\n";
  for (int i = 0; i < 8; ++i) still += std::to_string(0.1 * i) + "\t30\n";
  const Json solved = told("static-optimization --model " + model.string() + " --motion " +
                           folder.write("still.mot", still).string() + " --out " + folder.path().string());
  EXPECT_EQ(solved.at("rows"), 8);
  EXPECT_EQ(solved.at("too_weak").size(), 8u);
  EXPECT_NEAR(solved.at("too_weak")[0].at("missing").at("swing").get<double>(), 9.80665 * 0.5 - 1, 0.01);
  for (const std::string file : solved.at("files")) EXPECT_TRUE(std::filesystem::exists(file)) << file;
}

TEST(Json, of_motions_names_files_with_their_joints) {
  const TestFolder folder;
  const Json motions = told("motions " + model_in(folder) + " --range swing=-10:40 --steps 1 --out " +
                            (folder.path() / "motions").string());
  ASSERT_FALSE(motions.at("motions").empty());
  EXPECT_EQ(motions.at("motions")[0].at("joint"), "hinge");
  EXPECT_GT(motions.at("motions")[0].at("rows"), 2);
}

TEST(Json, of_an_import_says_what_was_left_out) {
  const TestFolder folder;
  const std::string too_long = "<optimal_fiber_length>12</optimal_fiber_length>";
  const auto model = folder.write(
      "tiny.osim", pendulum(muscle("m", from_ground_to_rod) + muscle("long", from_ground_to_rod, too_long)));
  const Json imported = told("import " + model.string() + " --out " + (folder.path() / "scene").string());
  EXPECT_EQ(imported.at("muscles"), 1);
  EXPECT_EQ(imported.at("scenes"), Json({(folder.path() / "scene/rest.toml").string()}));
  EXPECT_THAT(imported.at("left_out")[0].get<std::string>(), HasSubstr("long"));
}

TEST(Json, of_a_new_scene_says_what_is_missing) {
  const SceneFolder folder;
  folder.write_box("iliacus_r.ply", 0, 10);
  const std::string out = folder.path("my.toml").string();
  const Json made = told("new " + folder.path("iliacus_r.ply").string() + " --unit mm --out " + out);
  EXPECT_EQ(made.at("scene"), out);
  EXPECT_EQ(made.at("muscles"), 1);
  EXPECT_FALSE(made.at("missing").empty());
}

TEST(Json, of_a_study_lists_the_plan_and_the_collected) {
  const StudyFolder folder;
  const std::string study = folder.study(six_runs).string();
  const Json plan = told("study plan " + study);
  ASSERT_EQ(plan.at("runs").size(), 6u);
  EXPECT_THAT(plan.at("runs")[0].at("alone").get<std::string>(), HasSubstr("gracilis"));
  EXPECT_EQ(plan.at("complete"), 1);
  EXPECT_EQ(plan.at("left"), 5);
  for (const char* cost : {"seconds", "peak_memory_mb", "disk_mb"}) EXPECT_GT(plan.at("cost_of_a_run").at(cost), 0);
  const Json collected = told("study collect " + study);
  EXPECT_EQ(collected.at("collected"), 1) << "the one that the plan ran";
  EXPECT_EQ(collected.at("left"), 5);
  EXPECT_EQ(collected.at("files").size(), 4u);
}

}  // namespace
}  // namespace gracilis
