#include <gracilis/core/errors.hpp>
#include <gracilis/io/run/output_hashes.hpp>
#include <gracilis/study/run_measures.hpp>

#include "study/study_scenes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis {

namespace {

using testing::HasSubstr;

/// A run's folder with these rows of measures, and their hash.
std::filesystem::path run_with(const SceneFolder& folder, const std::string& rows) {
  folder.write("run/measures.csv", "frame,time_s,flexion_deg,muscle,spike\n" + rows);
  write_output_hashes(folder.path("run"));
  return folder.path("run");
}

std::string trouble_with(const std::filesystem::path& run) {
  try {
    read_run_measures(run);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST(RunMeasures, frames_and_muscles_are_those_of_the_table) {
  const SceneFolder folder;
  const RunMeasures measures = read_run_measures(run_with(folder, "0,0,2,a,0.5\n0,0,2,b,0.25\n1,0.1,3,a,0.75\n"));
  ASSERT_EQ(measures.rows.size(), 3u);
  EXPECT_EQ(measures.rows[2].frame, 1);
  EXPECT_EQ(measures.muscles, (std::vector<std::string>{"a", "b"}));
}

TEST(RunMeasures, what_numbers_no_frame_is_refused) {
  const SceneFolder folder;
  for (const std::string frame : {"-1", "0.5", "1e12", "99999999999", "nan", ""})
    EXPECT_THAT(trouble_with(run_with(folder, frame + ",0,2,a,0.5\n")),
                HasSubstr("measures.csv:2: '" + frame + "' is not the number of a frame"));
}

TEST(RunMeasures, a_muscle_twice_in_a_frame_is_refused) {
  const SceneFolder folder;
  EXPECT_THAT(trouble_with(run_with(folder, "0,0,2,a,0.5\n1,0,2,a,0.5\n1,0,2,a,0.6\n")),
              HasSubstr("measures.csv:4: frame 1 has two rows of 'a'"));
}

TEST(RunMeasures, a_file_that_has_changed_or_that_no_hash_is_known_of_is_refused) {
  const SceneFolder folder;
  const std::filesystem::path run = run_with(folder, "0,0,2,a,0.5\n");
  folder.write("run/measures.csv", "frame,time_s,flexion_deg,muscle,spike\n0,0,2,a,0.1\n");
  EXPECT_THAT(trouble_with(run), HasSubstr("has changed since the run ended"));
  run_with(folder, "0,0,2,a,0.5\n");
  folder.write("run/fiber_lengths.sto", "left by another run\n");
  EXPECT_THAT(trouble_with(run), HasSubstr("fiber_lengths.sto: is not in the run's list of hashes"));
  std::ofstream(run / output_hashes_name) << std::string(64, '0') << "  preview.png\n";
  EXPECT_THAT(trouble_with(run), HasSubstr("measures.csv: is not in the run's list of hashes"));
}

}  // namespace gracilis
