#include "app/program.hpp"
#include "study/study_scenes.hpp"

#include <gracilis/io/run/verify_run.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <random>
#include <sstream>
#include <thread>

namespace gracilis {

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// Six runs of a few frames, each a fraction of a second; two of the built-in hip's muscles.
const std::string six_runs =
    "scene = \"demo\"\nset = [\"method=skinning\"]\nonly = [\"iliacus_r\", \"adductor_brevis_r\"]\nmetrics = "
    "\"light\"\n"
    "fibers = false\n[sampling]\nkind = \"grid\"\n[[parameters]]\nkey = \"flexion\"\nrange = [2, 12]\nsteps = 6\n";

int status_of(const std::string& text, const std::string& state) {
  std::istringstream lines(text);
  int count = 0;
  for (std::string line; std::getline(lines, line);)
    if (line.ends_with(" " + state) && std::sscanf(line.c_str(), "%d", &count) == 1) return count;
  return 0;
}

/// Every run is there once, whole, with nothing beside it.
void expect_complete(const fs::path& folder, std::size_t count) {
  std::size_t runs = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / "runs")) {
    ++runs;
    EXPECT_TRUE(verify_run(entry.path()).findings.empty()) << entry.path();
    EXPECT_TRUE(fs::exists(entry.path() / "study.json"));
  }
  EXPECT_EQ(runs, count);
  EXPECT_TRUE(fs::is_empty(folder / "under_way"));
  EXPECT_TRUE(fs::is_empty(folder / "failures"));
}

}  // namespace

TEST(StudyCommand, killed_at_random_and_started_again_it_does_every_run_once_with_the_bits_of_a_run_alone) {
  const fs::path folder = empty_folder("killed");
  const fs::path study = write_study(folder, six_runs);
  std::mt19937 random(7);
  int kills = 0;
  for (int attempt = 0; attempt < 40; ++attempt) {
    const pid_t child = start_program({"study", "run", study.string()});
    std::this_thread::sleep_for(std::chrono::milliseconds(100 + random() % 900));
    kill(child, SIGKILL);
    const int code = end_of(child);
    if (code >= 0) {
      EXPECT_EQ(code, 0);
      break;
    }
    ++kills;
  }
  EXPECT_GE(kills, 1);
  EXPECT_EQ(run_program("study run " + study.string()).exit_code, 0);
  expect_complete(folder / "study", 6);

  const ProgramResult alone = run_program(
      "demo --flexion 6 --set method=skinning --only iliacus_r,adductor_brevis_r --metrics light --no-fibers "
      "--layout compact --out " +
      (folder / "alone").string());
  ASSERT_EQ(alone.exit_code, 0) << alone.err;
  EXPECT_FALSE(shapes_of(folder / "alone").empty());
  EXPECT_EQ(shapes_of(folder / "study/runs/0003"), shapes_of(folder / "alone"));

  const std::string before = read_text(folder / "study/runs/0004/study.json");
  EXPECT_THAT(run_program("study run " + study.string()).out, HasSubstr("6 complete before, 0 done now, 0 failed"));
  EXPECT_EQ(read_text(folder / "study/runs/0004/study.json"), before) << "what is complete stays";
  fs::remove_all(folder);
}

TEST(StudyCommand, processes_share_a_folder_whether_their_shards_are_the_same_or_not) {
  const fs::path folder = empty_folder("shared");
  const fs::path study = write_study(folder, six_runs);
  std::vector<pid_t> processes;
  for (const char* shard : {"1/2", "2/2", "1/1"})
    processes.push_back(start_program({"study", "run", study.string(), "--shard", shard}));
  for (const pid_t process : processes) EXPECT_EQ(end_of(process), 0);
  expect_complete(folder / "study", 6);

  const ProgramResult collected = run_program("study collect " + study.string());
  ASSERT_EQ(collected.exit_code, 0) << collected.err;
  EXPECT_THAT(read_text(folder / "study/measures.csv"),
              HasSubstr("run,muscle,frame,metric,value,unit\n0001,adductor_brevis_r,0,volume_ratio,1.000000,1\n"));
  EXPECT_EQ(lines_in(folder / "study/runs.csv"), 7u);
  EXPECT_EQ(read_text(folder / "study/failures.csv"), "run,exit_code,reason\n");
  EXPECT_THAT(read_text(folder / "study/frames.csv"), HasSubstr("0003,6,hip_flexion_r,6.0000,deg\n"));

  const ProgramResult reported = run_program("study report " + study.string() + " --worst 1");
  ASSERT_EQ(reported.exit_code, 0) << reported.err;
  const std::string page = read_text(folder / "study/report.html");
  for (const std::string text : {"6 runs: 6 complete.", "largest volume_ratio", "Spearman", "volume_ratio of"})
    EXPECT_THAT(page, HasSubstr(text));
  EXPECT_THAT(page, Not(HasSubstr("{{")));

  // Another definition: what has changed is made anew, the rest stays.
  std::string text = six_runs;
  text.replace(text.find("[2, 12]"), 7, "[2, 17]");
  write_study(folder, text);
  const std::string status = run_program("study status " + study.string()).out;
  EXPECT_EQ(status_of(status, "complete"), 1) << status;
  EXPECT_EQ(status_of(status, "stale"), 5) << status;
  EXPECT_THAT(run_program("study run " + study.string() + " --run 0001 --run 0002").out,
              HasSubstr("1 complete before, 1 done now, 0 failed"));
  EXPECT_EQ(status_of(run_program("study status " + study.string()).out, "complete"), 2);
  fs::remove_all(folder);
}

TEST(StudyCommand, a_run_that_fails_leaves_its_reason_and_the_others_go_on) {
  const fs::path folder = empty_folder("failing");
  const fs::path study = write_study(folder,
                                     "run,scene,flexion,method,iliacus_r.pressure\na,demo,2,skinning,\n"
                                     "b,demo,2,skinny,\nc,nowhere.toml,,,\nd,demo,2,skinning,\n",
                                     "rows.csv");
  const ProgramResult result = run_program("study run " + study.string());
  EXPECT_EQ(result.exit_code, 5);
  EXPECT_THAT(result.out, HasSubstr("2 done now, 2 failed"));
  const std::string status = run_program("study status " + study.string()).out;
  EXPECT_EQ(status_of(status, "complete"), 2) << status;
  EXPECT_EQ(status_of(status, "failed"), 1) << "a file may appear: c is to do\n" << status;
  EXPECT_EQ(status_of(status, "to do"), 1) << status;
  run_program("study collect " + study.string());
  const std::string failures = read_text(folder / "rows/failures.csv");
  EXPECT_THAT(failures, HasSubstr("\nb,2,"));
  EXPECT_THAT(failures, HasSubstr("skinny"));
  EXPECT_THAT(failures, HasSubstr("\nc,3,"));
  fs::remove_all(folder);
}

TEST(StudyCommand, a_run_over_its_time_is_ended_and_told) {
  const fs::path folder = empty_folder("time");
  const fs::path study = write_study(folder, "scene = \"demo\"\nmost_seconds = 0.2\n");
  EXPECT_EQ(run_program("study run " + study.string()).exit_code, 5);
  EXPECT_THAT(run_program("study status " + study.string()).out, HasSubstr("0001: failed: took longer than 0.2 s"));
  fs::remove_all(folder);
}

TEST(StudyCommand, what_is_wrong_with_the_study_is_told_before_anything_runs) {
  const fs::path folder = empty_folder("wrong");
  const fs::path study = write_study(folder, "scene = \"demo\"\nset = [\"iteratons=3\"]\n");
  const ProgramResult result = run_program("study run " + study.string());
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("iteratons"));
  EXPECT_FALSE(fs::exists(folder / "study"));
  for (const std::string shard : {"0/2", "3/2", "1", "a/b", "1/0"})
    EXPECT_EQ(run_program("study run " + study.string() + " --shard " + shard).exit_code, 2) << shard;
  EXPECT_THAT(run_program("study run " + study.string() + " --run 7").err, HasSubstr("no run '7'"));
  fs::remove_all(folder);
}

TEST(StudyCommand, a_plan_lists_runs_and_estimates_by_one_of_them_which_stays) {
  const fs::path folder = empty_folder("plan");
  const fs::path study = write_study(folder, six_runs);
  const ProgramResult plan = run_program("study plan " + study.string());
  ASSERT_EQ(plan.exit_code, 0) << plan.err;
  EXPECT_THAT(plan.out, HasSubstr("run,state,flexion,alone\n0001,to do,2,"));
  EXPECT_THAT(plan.out, HasSubstr("\n0004,complete,8,"));
  EXPECT_THAT(plan.err, HasSubstr("6 runs, 1 complete, 5 left"));
  EXPECT_EQ(run_program("study plan --names " + study.string()).out, "0001\n0002\n0003\n0004\n0005\n0006\n");
  fs::remove_all(folder);
}

}  // namespace gracilis
