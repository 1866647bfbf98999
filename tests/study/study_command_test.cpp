#include "app/program.hpp"
#include "study/study_scenes.hpp"

#include <gracilis/io/run/verify_run.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>
#include <random>
#include <sstream>
#include <thread>

namespace gracilis {

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

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
  std::vector<std::string> left;
  for (const char* part : {"under_way", "failures"})
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder / part))
      left.push_back(entry.path().lexically_relative(folder).string());
  EXPECT_THAT(left, testing::IsEmpty());
}

}  // namespace

TEST(StudyCommand, killed_at_random_and_started_again_it_does_every_run_once_with_the_bits_of_a_run_alone) {
  const StudyFolder folder;
  const fs::path study = folder.study(six_runs);
  std::mt19937 random(7);
  int kills = 0;
  for (int attempt = 0; attempt < 60; ++attempt) {
    const pid_t child = start_program({"study", "run", study.string()});
    std::this_thread::sleep_for(std::chrono::milliseconds(50 + random() % 400));
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
  expect_complete(folder.path("study"), 6);

  const ProgramResult alone =
      run_program("run " + folder.path("boxes.toml").string() +
                  " --set motion.step_deg=0.12 --metrics light --no-fibers --layout compact --out " +
                  folder.path("alone").string());
  ASSERT_EQ(alone.exit_code, 0) << alone.err;
  EXPECT_FALSE(shapes_of(folder.path("alone")).empty());
  EXPECT_EQ(shapes_of(folder.path("study/runs/0003")), shapes_of(folder.path("alone")));

  const std::string before = read_text(folder.path("study/runs/0004/study.json"));
  EXPECT_THAT(run_program("study run " + study.string()).out, HasSubstr("6 complete before, 0 done now, 0 failed"));
  EXPECT_EQ(read_text(folder.path("study/runs/0004/study.json")), before) << "what is complete stays";
  const nlohmann::json told = nlohmann::json::parse(run_program("study run --json " + study.string()).out);
  EXPECT_EQ(told.at("complete_before"), 6);
  EXPECT_EQ(told.at("failed"), 0);
}

TEST(StudyCommand, what_a_process_left_that_was_killed_after_its_run_was_complete_is_cleared_up) {
  const StudyFolder folder;
  const fs::path study = folder.study(six_runs);
  ASSERT_EQ(run_program("study run " + study.string()).exit_code, 0);
  fs::create_directories(folder.path("study/under_way/0003/old"));
  for (const char* left : {"definition.txt", "log.txt"}) folder.write("study/under_way/0003/" + std::string(left), "x");
  EXPECT_THAT(run_program("study run " + study.string()).out, HasSubstr("6 complete before, 0 done now, 0 failed"));
  expect_complete(folder.path("study"), 6);
}

TEST(StudyCommand, processes_share_a_folder_whether_their_shards_are_the_same_or_not) {
  const StudyFolder folder;
  const fs::path study = folder.study(six_runs);
  std::vector<pid_t> processes;
  for (const char* shard : {"1/2", "2/2", "1/1"})
    processes.push_back(start_program({"study", "run", study.string(), "--shard", shard}));
  for (const pid_t process : processes) EXPECT_EQ(end_of(process), 0);
  expect_complete(folder.path("study"), 6);

  const ProgramResult collected = run_program("study collect " + study.string());
  ASSERT_EQ(collected.exit_code, 0) << collected.err;
  EXPECT_THAT(read_text(folder.path("study/measures.csv")),
              HasSubstr("run,muscle,frame,metric,value,unit\n0001,muscle,0,volume_ratio,1.000000,1\n"));
  EXPECT_EQ(lines_in(folder.path("study/runs.csv")), 7u);
  EXPECT_EQ(read_text(folder.path("study/failures.csv")), "run,exit_code,reason\n");
  EXPECT_THAT(read_text(folder.path("study/frames.csv")), HasSubstr("0003,0,flexion,2.0000,deg\n"));

  const ProgramResult reported = run_program("study report " + study.string() + " --worst 1");
  ASSERT_EQ(reported.exit_code, 0) << reported.err;
  const std::string page = read_text(folder.path("study/report.html"));
  for (const std::string text : {"6 runs: 6 complete.", "last volume_ratio", "Spearman", "volume_ratio of"})
    EXPECT_NE(page.find(text), std::string::npos) << text;
  EXPECT_EQ(page.find("{{"), std::string::npos);

  // Another definition: what has changed is made anew, the rest stays.
  folder.study(with(six_runs, "0.11, 0.12", "0.1, 0.125"));
  const std::string status = run_program("study status " + study.string()).out;
  EXPECT_EQ(status_of(status, "complete"), 4) << status;
  EXPECT_EQ(status_of(status, "stale"), 2) << status;
  EXPECT_THAT(run_program("study run " + study.string() + " --run 0001 --run 0002").out,
              HasSubstr("1 complete before, 1 done now, 0 failed"));
  EXPECT_EQ(status_of(run_program("study status " + study.string()).out, "complete"), 5);
  const auto as_json = nlohmann::json::parse(run_program("study status --json " + study.string()).out);
  EXPECT_EQ(as_json.at("counts").at("complete"), 5);
  EXPECT_EQ(as_json.at("runs").size(), 6u);

  folder.write_box("muscle.ply", 11, 28.5);
  EXPECT_EQ(status_of(run_program("study status " + study.string()).out, "stale"), 6) << "a file has changed";
}

TEST(StudyCommand, a_run_that_fails_leaves_its_reason_and_the_others_go_on) {
  const StudyFolder folder;
  const fs::path study = folder.study(
      "run,scene,pressure\na,boxes.toml,\nb,boxes.toml,none\nc,nowhere.toml,\nd,boxes.toml,1.01\n", "rows.csv");
  const ProgramResult result = run_program("study run " + study.string());
  EXPECT_EQ(result.exit_code, 5);
  EXPECT_THAT(result.out, HasSubstr("2 done now, 2 failed"));
  const std::string status = run_program("study status " + study.string()).out;
  EXPECT_EQ(status_of(status, "complete"), 2) << status;
  EXPECT_EQ(status_of(status, "failed"), 1) << "a file may appear: c is to do\n" << status;
  EXPECT_EQ(status_of(status, "to do"), 1) << status;
  run_program("study collect " + study.string());
  const std::string failures = read_text(folder.path("rows/failures.csv"));
  EXPECT_THAT(failures, HasSubstr("\nb,2,"));
  EXPECT_THAT(failures, HasSubstr("pressure"));
  EXPECT_THAT(failures, HasSubstr("\nc,3,"));
  ASSERT_EQ(run_program("study report " + study.string() + " --worst 0").exit_code, 0);
  const std::string page = read_text(folder.path("rows/report.html"));
  for (const char* run : {"b", "c"}) EXPECT_THAT(page, HasSubstr("<td>" + std::string(run) + "</td>"));
}

TEST(StudyCommand, a_run_over_its_time_is_ended_and_told) {
  const StudyFolder folder;
  const fs::path study =
      folder.study("scene = \"boxes.toml\"\nset = [\"motion.step_deg=0.001\"]\nmost_seconds = 0.2\n");
  EXPECT_EQ(run_program("study run " + study.string()).exit_code, 5);
  EXPECT_THAT(run_program("study status " + study.string()).out, HasSubstr("0001: failed: took longer than 0.2 s"));
}

TEST(StudyCommand, what_is_wrong_with_the_study_is_told_before_anything_runs) {
  const StudyFolder folder;
  const fs::path study = folder.study("scene = \"boxes.toml\"\nset = [\"iteratons=3\"]\n");
  const ProgramResult result = run_program("study run " + study.string());
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("iteratons"));
  EXPECT_FALSE(fs::exists(folder.path("study")));
  for (const std::string shard : {"0/2", "3/2", "1", "a/b", "1/0"})
    EXPECT_EQ(run_program("study run " + study.string() + " --shard " + shard).exit_code, 2) << shard;
}

TEST(StudyCommand, a_plan_lists_runs_and_estimates_by_one_of_them_which_stays) {
  const StudyFolder folder;
  const fs::path study = folder.study(six_runs);
  const ProgramResult plan = run_program("study plan " + study.string());
  ASSERT_EQ(plan.exit_code, 0) << plan.err;
  EXPECT_THAT(plan.out, HasSubstr("run,state,motion.step_deg,alone\n0001,to do,0.1,"));
  EXPECT_THAT(plan.out, HasSubstr("\n0004,complete,0.13,"));
  EXPECT_THAT(plan.err, HasSubstr("6 runs, 1 complete, 5 left"));
  EXPECT_EQ(run_program("study plan --names " + study.string()).out, "0001\n0002\n0003\n0004\n0005\n0006\n");
  EXPECT_THAT(run_program("study run " + study.string() + " --run 7").err, HasSubstr("no run '7'"));
}

}  // namespace gracilis
