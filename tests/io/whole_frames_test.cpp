#include <gracilis/io/run/measures_table.hpp>
#include <gracilis/io/run/whole_frames.hpp>
#include <gracilis/io/tables/fiber_table.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/test_files.hpp>
#include <io/tiny_run.hpp>

using namespace gracilis;
using testing::HasSubstr;
namespace fs = std::filesystem;

namespace {

/// A tiny run with a fiber, of which any frame can be resumed.
struct FiberRun : TinyRun {
  FiberRun() { scene.method.contact["muscle"] = "none"; }

  FrameRecord record(int number) const {
    FrameRecord result = TinyRun::record(number);
    Points line(3, 2);
    line << 0, 0.1, 0, 0, 0, 0;
    result.fibers.resize(1);
    result.fibers[0].lines = join({line});
    result.fibers[0].lengths = {0.1};
    result.fibers[0].mean_length = 0.1;
    return result;
  }

  void write(const fs::path& folder, int frames) const {
    RunFolder out(folder, scene, poses, ExistingRun::replace);
    for (int i = 0; i < frames; ++i) out.write_frame(record(i));
  }

  /// How many frames are taken over after `spoil` has had its way with four.
  template <class Spoil>
  int resumed(const fs::path& folder, Spoil&& spoil) const {
    write(folder, 4);
    spoil();
    return RunFolder(folder, scene, poses, ExistingRun::resume).frame_count();
  }
};

/// Takes the last `count` bytes away.
void shorten(const fs::path& path, std::uintmax_t count) { fs::resize_file(path, fs::file_size(path) - count); }

}  // namespace

TEST(WholeFrames, what_was_written_is_whole) {
  const TestFolder folder;
  EXPECT_EQ(FiberRun().resumed(folder.path(), [] {}), 4);
}

TEST(WholeFrames, a_frame_without_its_row_of_measures_is_made_again) {
  const TestFolder folder;
  const FiberRun run;
  EXPECT_EQ(run.resumed(folder.path(), [&] { truncate_measures(folder.path() / "measures.csv", 3); }), 3);
  EXPECT_FALSE(fs::exists(frame_file(folder.path(), "femur_r", 3)));
}

TEST(WholeFrames, a_row_of_measures_that_was_cut_off_does_not_count) {
  const TestFolder folder;
  EXPECT_EQ(FiberRun().resumed(folder.path(), [&] { shorten(folder.path() / "measures.csv", 1); }), 3);
}

TEST(WholeFrames, a_frame_measured_twice_does_not_count) {
  const TestFolder folder;
  const FiberRun run;
  EXPECT_EQ(run.resumed(folder.path(),
                        [&] {
                          std::ofstream(folder.path() / "measures.csv", std::ios::app)
                              << measures_rows(run.scene, run.record(3));
                        }),
            3);
}

TEST(WholeFrames, a_frame_without_its_fibers_is_made_again) {
  const TestFolder folder;
  const FiberRun run;
  EXPECT_EQ(run.resumed(folder.path(), [&] { fs::remove(fiber_file(folder.path(), "gluteus_maximus_r", 3)); }), 3);
  EXPECT_EQ(run.resumed(folder.path(), [&] { shorten(folder.path() / "fiber_lengths.sto", 1); }), 3);
  EXPECT_EQ(run.resumed(folder.path(), [&] { fs::remove(folder.path() / "fiber_lengths.sto"); }), 0);
}

TEST(WholeFrames, a_run_without_fibers_needs_none) {
  const TestFolder folder;
  TinyRun run;
  run.scene.method.contact["muscle"] = "none";
  {
    RunFolder out(folder.path(), run.scene, run.poses, ExistingRun::refuse);
    for (int i = 0; i < 3; ++i) out.write_frame(run.record(i));
  }
  EXPECT_EQ(RunFolder(folder.path(), run.scene, run.poses, ExistingRun::resume).frame_count(), 3);
}

TEST(WholeFrames, surfaces_are_written_last) {
  const TestFolder folder;
  const TinyRun run;
  RunFolder out(folder.path(), run.scene, run.poses, ExistingRun::refuse);
  out.write_frame(run.record(0));
  fs::remove(folder.path() / "measures.csv");
  fs::create_directory(folder.path() / "measures.csv");  // where no row can be written
  EXPECT_THROW(out.write_frame(run.record(1)), InputError);
  EXPECT_FALSE(fs::exists(frame_file(folder.path(), "gluteus_maximus_r", 1)));
}

TEST(WholeFrames, what_a_kill_left_empty_is_no_error) {
  const TestFolder folder;
  const FiberRun run;
  for (const char* file : {"measures.csv", "fiber_lengths.sto"})
    EXPECT_EQ(run.resumed(folder.path(), [&] { fs::resize_file(folder.path() / file, 0); }), 0) << file;
}

TEST(WholeFrames, rows_under_other_columns_are_not_gone_on_with) {
  const TestFolder folder;
  FiberRun run;
  run.write(folder.path(), 3);
  run.scene.joints[0].axes[0].coordinate = "knee_angle_r";
  EXPECT_THAT(message_of_input_error([&] { RunFolder(folder.path(), run.scene, run.poses, ExistingRun::resume); }),
              HasSubstr("measures.csv:1: has other columns"));
  EXPECT_TRUE(fs::exists(frame_file(folder.path(), "femur_r", 2))) << "nothing is lost";
}
