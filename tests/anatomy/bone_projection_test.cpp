#include <gracilis/anatomy/overlap/bone_projection.hpp>

#include <scenes_for_tests.hpp>

#include <gtest/gtest.h>

namespace gracilis {

TEST(BoneProjection, points_keep_margins_of_their_own) {
  const Scene scene = tube_scene();
  Points rest(3, 4), now(3, 4);
  for (Index p = 0; p < 4; ++p) rest.col(p) = Vec3(0.025, 0, 0.05);  // 10 mm from the upper bone
  for (Index p = 0; p < 4; ++p) now.col(p) = Vec3(0.014, 0, 0.05);   // 1 mm in it
  const BoneProjection bones(scene, rest, {-1, -1, -1, 0}, tube_fields(), {0, 0.002, 0.02, 0.005}, true);
  EXPECT_GE(bones.push_out(flexed(scene, 0), now), 3);
  EXPECT_NEAR(now(0, 0), 0.015, 2e-5);
  EXPECT_NEAR(now(0, 1), 0.017, 2e-5);
  EXPECT_NEAR(now(0, 2), 0.025, 2e-5) << "no more than there is at rest";
  EXPECT_EQ(now(0, 3), 0.014) << "fixed";
}

TEST(BoneProjection, of_no_points_pushes_none) {
  Points none(3, 0);
  EXPECT_EQ(BoneProjection().push_out(capture_pose(2), none), 0);
}

}  // namespace gracilis
