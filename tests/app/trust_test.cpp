#include <gracilis/io/run/run_folder.hpp>
#include <gracilis/io/tables/table.hpp>

#include <build_paths.hpp>

#include "app/program.hpp"
#include "io/scene_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace gracilis {
namespace {

using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

/// What people hand to the program that they should not, and what stands in its way.
class Trust : public testing::Test {
 protected:
  Trust() { setenv("XDG_CACHE_HOME", folder.path("cache").c_str(), 1); }

  std::string scene(const std::string& text = good_scene()) const { return folder.write("scene.toml", text).string(); }
  std::string out() const { return folder.path("out").string(); }
  ProgramResult run(const std::string& text, const std::string& more = "") const {
    return run_program("run " + scene(text) + " --no-pictures --out " + out() + " " + more);
  }
  std::string bytes(const std::string& name) const {
    std::stringstream text;
    text << std::ifstream(folder.path(name), std::ios::binary).rdbuf();
    return text.str();
  }
  /// All files below the test's folder, by their paths in it.
  std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder.path("")))
      if (entry.is_regular_file()) names.insert(fs::relative(entry.path(), folder.path("")).string());
    return names;
  }

  SceneFolder folder;
};

// ---- Nothing is lost

TEST_F(Trust, a_run_killed_between_surfaces_and_measures_resumes_to_the_same_files) {
  ASSERT_EQ(run(good_scene(), "--layout compact --set fibers.count=3").exit_code, 0);
  const std::string fibers = bytes("out/fiber_lengths.sto"), surface = bytes("out/shapes/0012.vtp");
  const std::string measures = bytes("out/measures.csv");
  // As a kill leaves it: surfaces of the last frame, none of its measures, half a row of fibers.
  std::ofstream(folder.path("out/measures.csv")) << measures.substr(0, measures.rfind("\n12,") + 1);
  fs::resize_file(folder.path("out/fiber_lengths.sto"), fibers.size() - 9);
  const ProgramResult resumed = run(good_scene(), "--set fibers.count=3 --resume");
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_EQ(bytes("out/fiber_lengths.sto"), fibers);
  EXPECT_EQ(bytes("out/shapes/0012.vtp"), surface);
  const std::string again = bytes("out/measures.csv");
  EXPECT_EQ(std::count(again.begin(), again.end(), '\n'), std::count(measures.begin(), measures.end(), '\n'));
  EXPECT_EQ(run_program("report " + out()).exit_code, 0);
}

TEST_F(Trust, files_of_no_run_stay_and_what_a_run_leaves_alone_does_not_spoil_it) {
  folder.write("out/measures.csv", "mine");
  folder.write("out/plots/mine.txt", "");
  const ProgramResult refused = run(good_scene());
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("out/measures.csv: is not of a run"));
  EXPECT_EQ(bytes("out/measures.csv"), "mine");
  fs::remove(folder.path("out/measures.csv"));
  EXPECT_EQ(run_program("run " + scene() + " --out " + out()).exit_code, 0);  // draws beside what is there
  EXPECT_EQ(run_program("verify " + out()).exit_code, 0);
}

TEST_F(Trust, frames_without_number_are_refused_with_2_before_any_is_made) {
  const std::string far =
      with(with(good_scene(), "[[0], [10]]", "[[0], [1e9]]"), "[motion]", "[motion]\nstep_deg = 0.001");
  const ProgramResult refused = run(far);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("more than 1000000 frames"));
  EXPECT_FALSE(fs::exists(out()));
  const std::string rom = "rom " + scene() + " --out " + out() + " --coord ";
  EXPECT_EQ(run_program(rom + "flexion=0:1e308:1").exit_code, 2);
  EXPECT_EQ(run_program(rom + "flexion=0:10:1e-300").exit_code, 2);
  EXPECT_FALSE(fs::exists(out()));
}

TEST_F(Trust, a_setting_allows_more_or_fewer_frames) {
  EXPECT_EQ(run(good_scene(), "--set motion.max_frames=12").exit_code, 2);
  EXPECT_EQ(run(good_scene(), "--set motion.max_frames=13").exit_code, 0);
}

TEST_F(Trust, a_muscle_and_a_bone_of_one_name_are_refused) {
  const ProgramResult refused = run(with(good_scene(), "name = \"muscle\"", "name = \"femur\""));
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("muscle 'femur': a bone has the same name"));
}

TEST_F(Trust, coordinates_that_no_table_could_hold_are_refused_before_the_run) {
  for (const char* name : {"a,b", "a\\tb", "a\\nb", "time"}) {
    std::string text = with(good_scene(), "coordinate = \"flexion\"", std::string("coordinate = \"") + name + "\"");
    text = with(text, "coordinates = [\"flexion\"]", std::string("coordinates = [\"") + name + "\"]");
    const ProgramResult refused = run(text);
    EXPECT_EQ(refused.exit_code, 2) << name;
    EXPECT_THAT(refused.err, HasSubstr("is not fit for a column of a table")) << name;
    EXPECT_FALSE(fs::exists(out())) << name;
  }
}

TEST_F(Trust, a_damaged_distance_field_is_told_of_and_not_used) {
  ASSERT_EQ(run(good_scene()).exit_code, 0);
  const std::string expected = bytes("out/frames/muscle_0012.vtp");
  for (const auto& entry : fs::recursive_directory_iterator(folder.path("cache"))) {
    if (entry.path().extension() != ".field") continue;
    std::fstream stream(entry.path(), std::ios::in | std::ios::out | std::ios::binary);
    stream.seekp(static_cast<std::streamoff>(entry.file_size() / 2));
    stream.write("\xff\xff\xff\xff", 4);
  }
  const ProgramResult again = run(good_scene(), "--force");
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_THAT(again.err, HasSubstr("is damaged; made anew"));
  EXPECT_THAT(bytes("out/run.json"), HasSubstr("is damaged; made anew"));
  EXPECT_EQ(bytes("out/frames/muscle_0012.vtp"), expected);
}

// ---- Nothing is written elsewhere

TEST_F(Trust, a_scene_named_after_a_path_stays_in_its_folder) {
  const std::string text = with(good_scene(), "name = \"boxes\"", "name = \"../../outside\"");
  fs::create_directories(folder.path("deep/home"));
  const std::string command = "run " + scene(text);
  const std::string from_there = "--version >/dev/null; cd " + folder.path("deep/home").string() + " && " +
                                 std::string(build_paths::program) + " " + command;
  EXPECT_EQ(run_program(from_there).exit_code, 0);
  EXPECT_FALSE(fs::exists(folder.path("deep/outside")));
  EXPECT_FALSE(fs::exists(folder.path("outside")));
  EXPECT_TRUE(fs::exists(folder.path("deep/home/runs/_._.._outside/run.json")));
}

TEST_F(Trust, two_runs_into_one_folder_are_one_too_many) {
  const std::string slow = "run " + scene() + " --set iterations=20000 --out " + out();
  const std::string program(build_paths::program);
  const ProgramResult second = run_program(
      slow + " 2>/dev/null & pid=$!; while kill -0 $pid && [ ! -e " + frame_file(out(), "muscle", 0).string() +
      " ]; do sleep 0.05; done; " + program + " run " + scene() + " --force --out " + out() + " 2>&1; echo exit $?; " +
      program + " run " + scene() + " --resume --out " + out() + " 2>&1; echo exit $?; kill -KILL $pid; wait $pid; " +
      program + " run " + scene() + " --force --set iterations=20 --out " + out() + " 2>&1; echo exit $?; true");
  EXPECT_THAT(second.out, HasSubstr("is being written by process"));
  EXPECT_THAT(second.out, HasSubstr("exit 2\n"));
  EXPECT_THAT(second.out, testing::EndsWith("exit 0\n")) << "the lock of a killed run is taken over";
  for (const std::string& name : files()) EXPECT_THAT(name, Not(HasSubstr("/.gracilis-")));
  EXPECT_EQ(files().count("out/run.lock"), 0u);
}

TEST_F(Trust, a_run_resumed_with_other_settings_is_refused_and_left_as_it_is) {
  ASSERT_EQ(run(good_scene(), "--set iterations=20").exit_code, 0);
  const std::string before = bytes("out/run.json") + bytes("out/measures.csv");
  const ProgramResult refused = run(good_scene(), "--set iterations=21 --resume");
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_THAT(refused.err,
              HasSubstr("run.json: the run was begun with 'iterations = 20' where there is 'iterations = 21'"));
  EXPECT_EQ(bytes("out/run.json") + bytes("out/measures.csv"), before);
  EXPECT_EQ(run(good_scene(), "--set iterations=20 --resume").exit_code, 0);
}

TEST_F(Trust, a_full_disk_under_the_cache_does_not_end_a_picture) {
  ASSERT_EQ(run(good_scene()).exit_code, 0);
  // A disk of its own, as far as the system lets a test have one.
  const std::string in_a_full_disk =
      "unshare -rm sh -c 'mkdir -p $XDG_CACHE_HOME && mount -t tmpfs -o size=16k none $XDG_CACHE_HOME || exit 77; "
      "exec \"$0\" \"$@\"' ";
  const fs::path picture = folder.path("picture.png");
  const int status = std::system((in_a_full_disk + build_paths::program + " render " + out() + " --frames 0 --out " +
                                  picture.string() + " >" + folder.path("said").string() + " 2>&1")
                                     .c_str());
  if (WEXITSTATUS(status) == 77 || bytes("said").find("unshare") != std::string::npos) GTEST_SKIP() << bytes("said");
  if (bytes("said").find("no picture can be drawn") != std::string::npos) GTEST_SKIP() << bytes("said");
  EXPECT_EQ(WEXITSTATUS(status), 0) << bytes("said");
  EXPECT_TRUE(fs::exists(picture));
}

// ---- Exit codes

TEST_F(Trust, what_the_system_refuses_is_3_and_no_internal_error) {
  const auto refused = [&](const std::string& command) {
    const ProgramResult result = run_program(command);
    EXPECT_EQ(result.exit_code, 3) << command << "\n" << result.err;
    EXPECT_THAT(result.err, Not(HasSubstr("internal error"))) << command;
    return result.err;
  };
  fs::create_symlink("loop", folder.path("loop"));
  const std::string loop = folder.path("loop").string(), name(300, 'a');
  refused("run " + loop + "/scene.toml");
  refused("run " + folder.path(name).string());
  refused("inspect " + loop);
  refused("inspect " + folder.path(name).string());
  refused("report " + loop);
  refused("render " + loop + " --out a.png");
  refused("run " + scene() + " --out " + loop);
  refused("run " + scene() + " --out " + folder.path(name).string());
  refused("fibers " + scene() + " --out " + loop);
}

TEST_F(Trust, a_manifest_of_another_shape_is_3) {
  ASSERT_EQ(run(good_scene()).exit_code, 0);
  for (const char* text : {"[]", "null", "{\"scene\": 1}", "{\"warnings\": {}}", "{\"settings\": []}"}) {
    folder.write("out/run.json", text);
    for (const char* command : {"inspect ", "report ", "export --to gltf "})
      EXPECT_EQ(run_program(command + out()).exit_code, 3) << command << text;
  }
}

TEST_F(Trust, what_cannot_be_printed_is_told_of) {
  const ProgramResult full = run_program("inspect " + folder.path("pelvis.ply").string() + " >/dev/full");
  EXPECT_EQ(full.exit_code, 3);
  EXPECT_THAT(full.err, HasSubstr("the output cannot be written"));
  EXPECT_EQ(run_program("--version >/dev/full").exit_code, 3);
  EXPECT_EQ(run_program("run " + scene() + " --out " + out() + " >/dev/full").exit_code, 3);
}

TEST_F(Trust, a_limit_on_the_size_of_files_is_a_message_and_no_signal) {
  const std::string program(build_paths::program);
  const ProgramResult limited = run_program("--version >/dev/null; ulimit -f 8; " + program + " run " + scene() +
                                            " --out " + out() + " --set fibers.count=100");
  EXPECT_EQ(limited.exit_code, 3) << limited.err;
  EXPECT_THAT(limited.err, HasSubstr("cannot be written"));
}

// ---- What numbers mean

TEST_F(Trust, rom_takes_millimetres_where_a_coordinate_is_a_translation) {
  std::string text = with(good_scene(), "axis = [1, 0, 0]", "axis = [0, 0, 1]\ntranslation = true");
  text = with(text, "capture_deg = 2\nrange_deg = [-10, 20]", "capture_mm = 0\nrange_mm = [-10, 20]");
  text = with(text, "key_poses_deg = [[0], [10]]", "key_poses_mm = [[0], [1]]");
  const ProgramResult result =
      run_program("rom " + scene(text) + " --out " + out() + " --coord flexion=-1:1:0.5 --set fibers.count=3");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const Table table = read_table(folder.path("out/moment_arms.sto"));
  ASSERT_EQ(table.times.size(), 5u);
  EXPECT_NEAR(table.values(0, 0), -0.001, 1e-9) << "tables hold metres";
  EXPECT_NEAR(table.values(4, 0), 0.001, 1e-9);
  // The femur lies below: moving it up by a metre shortens what runs straight down by as much.
  EXPECT_THAT(result.out, HasSubstr("mm per m of flexion"));
  EXPECT_NEAR(table.values(2, 1), 1, 0.3);
  EXPECT_THAT(bytes("out/plots/moment_arms.svg"), HasSubstr("flexion (mm)"));
  EXPECT_THAT(run_program("rom --help").out, HasSubstr("in mm where the coordinate is a translation"));
}

TEST_F(Trust, rom_without_fibers_says_that_there_are_no_moment_arms) {
  const ProgramResult result =
      run_program("rom " + scene() + " --out " + out() + " --coord flexion=0:2:1 --set fibers.count=0");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("there are no moment arms"));
  EXPECT_THAT(bytes("out/measures.csv"), Not(HasSubstr("nan")));
  EXPECT_THAT(run_program("rom " + scene() + " --out " + out() + "2 --coord flexion=0:2:1 --no-fibers").err,
              HasSubstr("leave out '--no-fibers'"));
}

TEST_F(Trust, settings_at_their_limits_name_what_is_too_large) {
  const ProgramResult grid = run(good_scene(), "--set distance_field.resolution=1024");
  EXPECT_EQ(grid.exit_code, 2);
  EXPECT_THAT(grid.err, HasSubstr("'resolution' asks for grids of"));
  const ProgramResult fibers = run(good_scene(), "--set fibers.count=100000 --set fibers.segments=10000");
  EXPECT_EQ(fibers.exit_code, 2);
  EXPECT_THAT(fibers.err, HasSubstr("'count' and 'segments' ask for"));
}

}  // namespace
}  // namespace gracilis
