#include <gracilis/view/pictures/pose_caption.hpp>
#include <gracilis/view/pictures/preview.hpp>
#include <gracilis/view/pictures/run_picture.hpp>

#include "view/recorded_runs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/test_files.hpp>

namespace gracilis {

TEST(PoseCaption, tells_the_angle_after_the_capture_pose) {
  const TestFolder folder;
  const CaptionedFrames frames = captioned_frames(FlexingLeg(21).written(folder.path()));
  EXPECT_EQ(pose_caption(frames, 0), "capture pose");
  EXPECT_EQ(pose_caption(frames, 20), "hip flexion r 60°");
}

TEST(PoseCaption, is_the_same_in_a_preview_and_in_pictures_of_the_run) {
  const TestFolder folder;
  const FlexingLeg leg(21);
  const RecordedRun run = leg.written(folder.path());
  const Picture preview = preview_picture(leg.scene, leg.poses, {leg.record(0).frame, leg.record(20).frame});
  const RunPainter painter(run, {});
  EXPECT_EQ(preview.panels[0].caption, painter.panel(0).caption);
  EXPECT_EQ(preview.panels[1].caption, painter.panel(20).caption);
}

TEST(PoseCaption, tells_the_time_in_every_frame_where_many_coordinates_move_or_none) {
  CaptionedFrames frames;
  frames.times = {-0.1, -0.05, 0, 0.25};
  frames.first_motion_frame = 2;
  frames.coordinates = {{"a", "°"}, {"b", "°"}, {"c", " mm"}, {"d", "°"}};
  frames.values = Eigen::Vector4d(0, 10, 20, 30).replicate(1, 4);
  const auto expect_times = [&] {
    EXPECT_EQ(pose_caption(frames, 0), "capture pose");
    EXPECT_EQ(pose_caption(frames, 1), "frame 1, on the way to the motion");
    EXPECT_EQ(pose_caption(frames, 3), "frame 3, 0.25 s");
    EXPECT_EQ(pose_words(frames, 1), "on the way to the motion") << "beside the number of the frame";
    EXPECT_EQ(pose_words(frames, 3), "0.25 s");
  };
  expect_times();
  frames.values.setConstant(30);
  expect_times();
  frames.values.col(2) << 0, -5, -0.4, -12;
  EXPECT_EQ(pose_caption(frames, 2), "c 0 mm") << "which moves most is always told, and never as -0";
  EXPECT_EQ(pose_caption(frames, 3), "c -12 mm");
}

TEST(PoseCaption, of_a_scene_that_is_moved_live_names_what_has_left_the_capture_pose) {
  const FlexingLeg leg(21);
  EXPECT_EQ(pose_caption(leg.scene, leg.record(0).frame), "capture pose");
  EXPECT_EQ(pose_caption(leg.scene, leg.record(20).frame), "hip flexion r 60°");
}

}  // namespace gracilis
