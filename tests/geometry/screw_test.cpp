#include <gracilis/geometry/screw.hpp>

#include <gtest/gtest.h>

namespace gracilis {

static const RigidTransform motion =
    Eigen::Translation3d(0.1, -0.2, 0.3) * Eigen::AngleAxisd(1.1, Vec3(1, 2, -2).normalized());

TEST(Screw, shares_of_a_turn_about_a_hinge_stay_on_the_hinge) {
  const Vec3 hinge(5000, -3000, 8000);
  const RigidTransform turn =
      Eigen::Translation3d(hinge) * Eigen::AngleAxisd(0.02, Vec3::UnitY()) * Eigen::Translation3d(-hinge);
  for (const Real t : {0.0, 0.3, 0.5, 1.0}) {
    const RigidTransform share = share_of_screw(turn, t);
    EXPECT_LT((share * hinge - hinge).norm(), 1e-9) << t;
    EXPECT_NEAR(Eigen::AngleAxisd(share.linear()).angle(), 0.02 * t, 1e-12);
  }
}

TEST(Screw, shares_do_not_depend_on_the_frame) {
  const RigidTransform frame = Eigen::Translation3d(30, 20, -10) * Eigen::AngleAxisd(2, Vec3(3, -1, 1).normalized());
  const RigidTransform here = share_of_screw(motion, 0.4),
                       there = share_of_screw(frame * motion * frame.inverse(), 0.4);
  EXPECT_TRUE((frame * here * frame.inverse()).isApprox(there, 1e-12));
}

TEST(Screw, two_halves_are_the_whole_and_a_shift_is_shared_evenly) {
  const RigidTransform half = share_of_screw(motion, 0.5);
  EXPECT_TRUE((half * half).isApprox(motion, 1e-12));
  const RigidTransform shift(Eigen::Translation3d(3, 0, -4));
  EXPECT_TRUE(share_of_screw(shift, 0.25).translation().isApprox(Vec3(0.75, 0, -1), 1e-12));
}

}  // namespace gracilis
