#include <gracilis/io/mesh/polyline_file.hpp>
#include <gracilis/io/tables/table.hpp>

#include "app/program.hpp"
#include "io/scene_folder.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace gracilis {
namespace {

using testing::HasSubstr;

class FiberCommands : public testing::Test {
 protected:
  FiberCommands() { setenv("XDG_CACHE_HOME", folder.path("cache").c_str(), 1); }

  ProgramResult run(const std::string& command, const std::string& scene, const std::string& more = "") const {
    return run_program(command + " " + folder.write("scene.toml", scene).string() + " --out " +
                       folder.path("out").string() + " " + more);
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(folder.path(name)); }

  SceneFolder folder;
};

TEST_F(FiberCommands, fibers_writes_lines_and_says_how_long_they_are) {
  const ProgramResult result = run("fibers", good_scene(), "--set fibers.count=7 --set fibers.segments=4");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("muscle: 7 fibers, 1"));
  EXPECT_THAT(result.out, HasSubstr("  on the surface, nearest vertices joined: "));
  const Polylines lines = read_polylines(folder.path("out/muscle_fibers.vtp"), 1);
  ASSERT_EQ(lines.count(), 7);
  EXPECT_EQ(lines.size(0), 5);
}

TEST_F(FiberCommands, fibers_tells_programs_the_same_in_si_units) {
  const std::string more = "--set fibers.count=7 --set fibers.segments=4";
  const ProgramResult result = run("fibers", good_scene(), more + " --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const nlohmann::json told = nlohmann::json::parse(result.out);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0]["muscle"], "muscle");
  EXPECT_EQ(told[0]["fibers"], 7);
  const double length = told[0]["mean_length_m"];
  const std::string in_words = run("fibers", good_scene(), more).out;
  EXPECT_THAT(in_words, HasSubstr(fmt::format("{:.1f} mm long", 1000 * length)));
  EXPECT_EQ(told[0]["on_surface"].size(), 2u);
  for (const nlohmann::json& carried : told[0]["on_surface"])
    EXPECT_THAT(in_words, HasSubstr(fmt::format("{}: {} segments", carried["carried"].get<std::string>(),
                                                carried["segments"].get<std::size_t>())));
}

TEST_F(FiberCommands, a_muscle_may_bring_fibers_of_its_own) {
  Polylines own;
  own.append((Points(3, 2) << 0.005, 0.005, 0.005, 0.005, 0.012, 0.028).finished());
  write_polylines(folder.path("own.vtp"), own);
  const std::string scene =
      with(good_scene(), "[[muscles.attachments]]\nname = \"top\"",
           "[muscles.fibers]\nfile = \"own.vtp\"\nsegments = 3\n[[muscles.attachments]]\nname = \"top\"");
  EXPECT_EQ(run("fibers", scene).exit_code, 0);
  const Polylines lines = read_polylines(folder.path("out/muscle_fibers.vtp"), 1);
  ASSERT_EQ(lines.count(), 1);
  EXPECT_EQ(lines.size(0), 4);
  EXPECT_GT(lines.points(2, 0), lines.points(2, 3)) << "turned to begin at the origin";
}

TEST_F(FiberCommands, a_run_leaves_fiber_lengths_fibers_and_plots) {
  EXPECT_EQ(run("run", good_scene(), "--set fibers.count=3").exit_code, 0);
  const Table table = read_table(folder.path("out/fiber_lengths.sto"));
  EXPECT_TRUE(table.warnings.empty());
  EXPECT_EQ(table.columns,
            (std::vector<std::string>{"flexion", "muscle", "muscle_f000", "muscle_f001", "muscle_f002"}));
  EXPECT_EQ(table.times.size(), 13u);
  EXPECT_NEAR(table.values(12, 0), 10, 1e-9);
  EXPECT_NEAR(table.values(5, 1), table.values.row(5).tail(3).mean(), 1e-8);
  EXPECT_TRUE(exists("out/fibers/muscle_0012.vtp"));
  EXPECT_TRUE(exists("out/plots/volume.svg"));
  EXPECT_TRUE(exists("out/plots/fiber_lengths_muscle.svg"));
}

TEST_F(FiberCommands, a_resumed_run_goes_on_with_its_fiber_lengths) {
  EXPECT_EQ(run("run", good_scene(), "--set fibers.count=3").exit_code, 0);
  const Table whole = read_table(folder.path("out/fiber_lengths.sto"));
  for (int frame = 7; frame <= 12; ++frame)
    std::filesystem::remove(
        folder.path("out/frames/muscle_00" + std::string(frame < 10 ? "0" : "") + std::to_string(frame) + ".vtp"));
  EXPECT_EQ(run("run", good_scene(), "--set fibers.count=3 --resume").exit_code, 0);
  const Table resumed = read_table(folder.path("out/fiber_lengths.sto"));
  EXPECT_TRUE(resumed.warnings.empty());
  ASSERT_EQ(resumed.times, whole.times);
  EXPECT_NEAR((resumed.values - whole.values).cwiseAbs().maxCoeff(), 0, 1e-12);
}

TEST_F(FiberCommands, a_scene_without_fibers_runs_without_them) {
  EXPECT_EQ(run("run", good_scene(), "--set fibers.count=0").exit_code, 0);
  EXPECT_FALSE(exists("out/fiber_lengths.sto"));
  EXPECT_FALSE(exists("out/fibers"));
  EXPECT_TRUE(exists("out/plots/volume.svg"));
}

TEST_F(FiberCommands, rom_writes_moment_arms_over_its_range_alone) {
  const ProgramResult result = run("rom", good_scene(), "--coord flexion=-4:4:2 --set fibers.count=3");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("muscle: moment arm about flexion"));
  const Table table = read_table(folder.path("out/moment_arms.sto"));
  ASSERT_EQ(table.times.size(), 5u);
  EXPECT_NEAR(table.values(0, 0), -4, 1e-9);
  EXPECT_NEAR(table.values(4, 0), 4, 1e-9);
  EXPECT_TRUE(exists("out/plots/moment_arms.svg"));
}

TEST_F(FiberCommands, rom_compares_moment_arms_with_a_reference) {
  folder.write("published.csv",
               "muscle,angle_deg,coordinate,source,moment_arm_mm\n"
               "muscle,-4,flexion,first,10\nmuscle,2,flexion,first,10\n"
               "muscle,-4,flexion,second,20\nmuscle,4,flexion,second,20\n"
               "muscle,0,rotation,first,99\nother,0,flexion,first,99\n");
  const std::string reference = " --reference " + folder.path("published.csv").string();
  const ProgramResult result =
      run("rom", good_scene(), "--coord flexion=-4:4:2 --set method=skinning --set fibers.count=3" + reference);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("beside first: "));
  EXPECT_THAT(result.out, HasSubstr("from -4 to 2 degrees"));
  EXPECT_THAT(result.out, HasSubstr("from -4 to 4 degrees"));
  EXPECT_THAT(result.out, HasSubstr("beyond the band of all 2"));
  const Table arms = read_table(folder.path("out/moment_arms.sto"));
  std::ifstream file(folder.path("out/reference.csv"));
  std::string head, first, second, more;
  std::getline(file, head), std::getline(file, first), std::getline(file, second);
  EXPECT_FALSE(std::getline(file, more)) << more;
  ASSERT_TRUE(first.starts_with("muscle,first,4,-4.00,2.00,")) << first;
  ASSERT_TRUE(second.starts_with("muscle,second,5,-4.00,4.00,")) << second;
  const Real rms = std::sqrt((arms.values.col(1).array() - 0.02).square().mean()) * 1e3;
  EXPECT_NEAR(std::stod(second.substr(std::string("muscle,second,5,-4.00,4.00,").size())), rms, 1e-3);
  std::ifstream chart(folder.path("out/plots/moment_arms_muscle.svg"));
  EXPECT_THAT(std::string(std::istreambuf_iterator<char>(chart), {}), HasSubstr("second"));
}

TEST_F(FiberCommands, rom_refuses_a_reference_that_is_no_table_before_it_runs) {
  folder.write("published.csv", "angle_deg\n");
  const ProgramResult result =
      run("rom", good_scene(), "--coord flexion=-4:4:2 --reference " + folder.path("published.csv").string());
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr("names no column 'muscle'"));
  EXPECT_FALSE(exists("out"));
}

TEST_F(FiberCommands, rom_says_what_is_wrong_with_its_coordinates) {
  for (const char* bad : {"flexion=1", "flexion=1:2", "flexion=a:b:c", "flexion=0:10:-1", "=0:10:1", "flexion"})
    EXPECT_EQ(run("rom", good_scene(), std::string("--coord ") + bad).exit_code, 2) << bad;
  const ProgramResult unknown = run("rom", good_scene(), "--coord flexon=0:10:1");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("did you mean 'flexion'?"));
}

TEST_F(FiberCommands, activations_reach_the_measures_in_every_way) {
  folder.write("samples.sto",
               "samples\nversion=1\nnRows=2\nnColumns=3\ninDegrees=yes\nendheader\ntime\tflexion\tmuscle\n0\t2\t0."
               "25\n1\t90\t1\n");
  folder.write("time.sto", "a\nversion=1\nnRows=1\nnColumns=2\ninDegrees=no\nendheader\ntime\tpart\n0\t0.75\n");
  const auto first_activation = [&](const std::string& more) {
    const ProgramResult result = run("run", good_scene() + more, "--force --set fibers.count=1");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    std::ifstream file(folder.path("out/measures.csv"));
    std::string header, row;
    std::getline(file, header);
    std::getline(file, row);
    const auto index =
        std::count(header.begin(), header.begin() + static_cast<std::ptrdiff_t>(header.find("activation")), ',');
    std::stringstream cells(row);
    std::string cell;
    for (std::ptrdiff_t i = 0; i <= index; ++i) std::getline(cells, cell, ',');
    return std::stod(cell);
  };
  EXPECT_EQ(first_activation(""), 0);
  EXPECT_EQ(first_activation("[[activations]]\nmuscle = \"muscle\"\nvalue = 0.5\n"), 0.5);
  EXPECT_EQ(first_activation("[[activations]]\nmuscle = \"muscle\"\nfile = \"time.sto\"\ncolumn = \"part\"\n"), 0.75);
  EXPECT_EQ(first_activation(
                "[[activations]]\nmuscle = \"muscle\"\ncoordinate = \"flexion\"\npoints_deg = [[0, 0], [4, 0.8]]\n"),
            0.4);
  EXPECT_EQ(first_activation("[[joint_control_units]]\nname = \"hip\"\njoint = \"hip\"\nsamples = \"samples.sto\"\n"),
            0.25);
  const std::string full =
      "[[joint_control_units]]\nname = \"hip\"\njoint = \"hip\"\nsamples = \"full.sto\"\nneighbors = 1\n";
  const std::string head = "x\nversion=1\nnRows=2\nnColumns=3\ninDegrees=yes\nendheader\n";
  folder.write("full.sto", head + "time\tflexion\tmuscle\n0\t2\t1.5\n1\t90\t0.5\n");
  EXPECT_EQ(first_activation(full), 1);
  EXPECT_THAT(run("run", good_scene() + full, "--force --set fibers.count=1").err,
              HasSubstr("muscle is above 1 in 1 of 2 samples, up to 1.500"));
  folder.write("walk.mot", head + "time\tflexion\tknee\n0\t2\t0\n1\t90\t0\n");
  folder.write("parts.sto", head + "time\tmuscle1\tmuscle2\n0\t0.125\t0.5\n1\t1\t1\n");
  folder.write("forces.sto", head + "time\tmuscle1\tmuscle2\n0\t150\t100\n1\t1\t1\n");
  folder.write("names.toml", "muscle = [\"muscle1\", \"muscle2\"]\n");
  const std::string unit =
      "[[joint_control_units]]\nname = \"hip\"\njoint = \"hip\"\nmotion = \"walk.mot\"\nresults = \"parts.sto\"\n"
      "names = \"names.toml\"\n";
  EXPECT_EQ(first_activation(unit), 0.625);
  EXPECT_EQ(first_activation(unit + "combine = \"maximum\"\n"), 0.5);
  EXPECT_NEAR(first_activation(unit + "combine = \"weighted_mean\"\nforces = \"forces.sto\"\n"), 0.275, 1e-12);
  const ProgramResult unweighted = run("run", good_scene() + unit + "combine = \"weighted_mean\"\n", "--force");
  EXPECT_EQ(unweighted.exit_code, 2);
  EXPECT_THAT(unweighted.err, HasSubstr("need each other"));
  const ProgramResult twice =
      run("run", good_scene() + "[[activations]]\nmuscle = \"muscle\"\nvalue = 0.5\nfile = \"time.sto\"\n", "--force");
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_THAT(twice.err, HasSubstr("in exactly one way"));
}

TEST_F(FiberCommands, activations_join_writes_samples_and_lists_problems) {
  const std::string head = "x\nversion=1\nnRows=3\nnColumns=2\ninDegrees=yes\nendheader\n";
  folder.write("m/walk.mot", head + "time\tflexion\n0\t0\n0.1\t5\n0.2\t9\n");
  folder.write("r/walk.sto", head + "time\tpart1\n0\t0.2\n0.1\t0.4\n0.3\t0.6\n");
  const ProgramResult result = run_program("activations join " + folder.path("m").string() + " " +
                                           folder.path("r").string() + " --out " + folder.path("samples.sto").string());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("1 of 3 times of the results have no row of the motion"));
  EXPECT_EQ(read_table(folder.path("samples.sto")).times.size(), 2u);
  const ProgramResult again = run_program("activations join --json " + folder.path("m").string() + " " +
                                          folder.path("r").string() + " --out " + folder.path("samples.sto").string());
  const nlohmann::json told = nlohmann::json::parse(again.out);
  EXPECT_EQ(told.at("samples"), 2);
  EXPECT_EQ(told.at("coordinates"), nlohmann::json({"flexion"}));
  EXPECT_TRUE(told.at("left_out_rms").contains("part1"));
  EXPECT_EQ(
      run_program("activations join " + folder.path("m").string() + " " + folder.path("none").string() + " --out x.sto")
          .exit_code,
      3);
}

TEST_F(FiberCommands, activations_neighbors_shows_which_samples_are_asked) {
  const std::string head = "x\nversion=1\nnRows=4\nnColumns=3\ninDegrees=yes\nendheader\n";
  const std::string samples =
      folder
          .write("samples.sto",
                 head + "time\tflexion\tturn\tmuscle\n0\t0\t0\t0.1\n1\t10\t0\t0.2\n2\t0\t10\t0.3\n3\t10\t10\t0.4\n")
          .string();
  const std::string motion =
      folder.write("motion.mot", head + "time\tturn\tflexion\tother\n0\t0\t0\t7\n1\t0\t2\t7\n2\t0\t4\t7\n3\t0\t8\t7\n")
          .string();
  const std::string out = folder.path("neighbors").string();
  const auto content = [&](const std::string& name) {
    std::stringstream text;
    text << std::ifstream(folder.path(name)).rdbuf();
    return text.str();
  };
  const std::string command = "activations neighbors " + samples + " " + motion + " --neighbors 2 --out " + out;
  const ProgramResult result = run_program(command);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("2 of 4 samples are asked in 4 poses"));
  // The first pose is a sample's own: no other one is asked there.
  EXPECT_EQ(content("neighbors/neighbors.csv"), "flexion_deg,turn_deg,poses\n0,0,4\n0,10,0\n10,0,3\n10,10,0\n");
  EXPECT_THAT(content("neighbors/flexion_turn.svg"), HasSubstr("2 of 4 samples are asked in 4 poses"));
  const nlohmann::json told = nlohmann::json::parse(run_program(command + " --coord flexion --json").out);
  EXPECT_EQ(told.at("samples"), 2);
  EXPECT_EQ(told.at("asked"), 2);
  EXPECT_TRUE(std::filesystem::exists(out + "/flexion.svg"));
  EXPECT_THAT(run_program(command + " --coord flexoin").err, HasSubstr("has no coordinate 'flexoin'"));
}

}  // namespace
}  // namespace gracilis
