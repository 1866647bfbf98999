#include <gracilis/anatomy/pose_sequence.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis {
namespace {

using testing::ElementsAre;

constexpr SequenceParts parts = {4, 1, 6, 0, 2};  // frames 0 to 4, 5 to 10, 11 and 12

TEST(RecordedFrames, are_every_nth_and_the_last) {
  EXPECT_THAT(recorded_frames(parts, 5, true), ElementsAre(0, 5, 10, 12));
  EXPECT_THAT(recorded_frames(parts, 6, true), ElementsAre(0, 6, 12));
  EXPECT_EQ(recorded_frames(parts, 1, true).size(), 13u);
  EXPECT_THAT(recorded_frames(parts, 100, true), ElementsAre(0, 12));
}

TEST(RecordedFrames, without_ramps_are_the_capture_pose_and_the_motion) {
  EXPECT_THAT(recorded_frames(parts, 1, false), ElementsAre(0, 5, 6, 7, 8, 9, 10));
  EXPECT_THAT(recorded_frames(parts, 2, false), ElementsAre(0, 5, 7, 9, 10));
  const SequenceParts no_ramp = {0, 0, 3, 0, 0};
  EXPECT_THAT(recorded_frames(no_ramp, 1, false), ElementsAre(0, 1, 2));
  const SequenceParts no_motion = {0, 0, 1, 0, 0};
  EXPECT_THAT(recorded_frames(no_motion, 3, false), ElementsAre(0));
}

}  // namespace
}  // namespace gracilis
