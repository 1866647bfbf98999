#include <gracilis/io/run/output_hashes.hpp>
#include <gracilis/study/collect.hpp>
#include <gracilis/study/study_reader.hpp>

#include "study/study_scenes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gracilis {

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A study of one run, and the run's folder as far as it tells what the run has come to.
struct RecordedStudy : StudyFolder {
  Study study = read_study(StudyFolder::study("scene = \"boxes.toml\"\n"));

  /// Complete, with these inputs in its run.json.
  void complete(const nlohmann::json& inputs) const {
    const fs::path run = complete_folder(study, study.runs[0]);
    write("study/runs/0001/measures.csv", "frame,time_s,flexion_deg,muscle,spike\n0,0,2,muscle,0.5\n");
    const nlohmann::json manifest = {
        {"status", "complete"}, {"outputs_sha256", write_output_hashes(run)}, {"inputs", inputs}};
    write("study/runs/0001/run.json", manifest.dump());
    RunRecord record;
    record.definition = run_definition(study, study.runs[0], "1");
    write_run_record(run / "study.json", record);
  }
  /// Complete, and it read the muscle.
  void complete() const {
    const std::string file = path("muscle.ply").string();
    const nlohmann::json input = {{"file", file}, {"sha256", content_hash(file)}};
    complete(nlohmann::json::array({input}));
  }
  RunStanding standing(AbsentInput absent = AbsentInput::makes_stale) const {
    InputHashes hashes;
    return standing_of(study, study.runs[0], "1", hashes, absent);
  }
};

}  // namespace

TEST(RunRecord, a_file_that_is_not_there_makes_a_run_stale_unless_runs_are_only_looked_at) {
  const RecordedStudy study;
  study.complete();
  EXPECT_EQ(study.standing().state, RunState::complete);
  EXPECT_EQ(collect_study(study.study, "1").remark, "");
  fs::remove(study.path("muscle.ply"));
  EXPECT_EQ(study.standing().state, RunState::stale);
  EXPECT_EQ(study.standing(AbsentInput::is_passed_over).state, RunState::complete);
  const CollectEnd collected = collect_study(study.study, "1");
  EXPECT_EQ(collected.collected, 1);
  EXPECT_THAT(collected.remark, HasSubstr("1 of 1 files that runs read are not there"));
  EXPECT_THAT(collected.remark, HasSubstr("muscle.ply"));
}

TEST(RunRecord, a_file_that_has_changed_makes_a_run_stale_for_all) {
  const RecordedStudy study;
  study.complete();
  study.write_box("muscle.ply", 11, 28);
  EXPECT_EQ(study.standing(AbsentInput::is_passed_over).state, RunState::stale);
  const CollectEnd collected = collect_study(study.study, "1");
  EXPECT_EQ(collected.collected, 0);
  EXPECT_EQ(collected.left, 1);
}

TEST(RunRecord, an_exit_code_that_no_program_has_makes_it_no_record) {
  const RecordedStudy study;
  for (const char* code : {"1e300", "-1", "256", "4294967296", "0.5"}) {
    const std::string text =
        std::string(R"({"definition": "d", "exit_code": )") + code +
        R"(, "reason": "", "seconds": 1, "processor_seconds": 1, "peak_memory_bytes": 1, "host": "h"})";
    EXPECT_FALSE(read_run_record(study.write("study.json", text))) << code;
  }
  const std::string text = R"({"definition": "d", "exit_code": 255, "reason": "", "seconds": 1, "processor_seconds": 1,
                              "peak_memory_bytes": 1, "host": "h"})";
  EXPECT_EQ(read_run_record(study.write("study.json", text)).value().code, 255);
}

TEST(RunRecord, inputs_that_are_no_texts_make_a_run_stale_and_are_named) {
  const RecordedStudy study;
  study.complete(nlohmann::json::array({nlohmann::json::object()}));
  EXPECT_EQ(study.standing().state, RunState::stale);
  study.complete(nlohmann::json::array({{{"file", 5}, {"sha256", "0"}}}));
  EXPECT_EQ(study.standing().state, RunState::stale);
  EXPECT_THAT(study.standing().reason, HasSubstr("run.json: 'inputs' must be a list of files and hashes"));
}

TEST(RunRecord, what_can_come_out_otherwise_is_to_do_and_has_failed_all_the_same) {
  const RecordedStudy study;
  RunRecord record;
  record.definition = run_definition(study.study, study.study.runs[0], "1");
  record.code = 1;
  record.reason = "was ended by signal 9";
  fs::create_directories(study.path("study/failures"));
  write_run_record(failure_file(study.study, study.study.runs[0]), record);
  EXPECT_EQ(study.standing().state, RunState::to_do);
  EXPECT_TRUE(has_failed(study.standing()));
  record.code = 5;
  write_run_record(failure_file(study.study, study.study.runs[0]), record);
  EXPECT_EQ(study.standing().state, RunState::failed);
  EXPECT_TRUE(has_failed(study.standing()));
}

}  // namespace gracilis
