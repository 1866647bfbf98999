#include <gracilis/anatomy/fibers/nearest_fiber.hpp>

#include <gtest/gtest.h>

namespace gracilis {
namespace {

/// One fiber along x at z = 0, one along y at z = 1, and a point without a length.
Polylines two_fibers() {
  Points along_x(3, 3), along_y(3, 2), point(3, 2);
  along_x << 0, 0.5, 1, 0, 0, 0, 0, 0, 0;
  along_y << 0.5, 0.5, 0, 1, 1, 1;
  point << 0.5, 0.5, 0, 0, 0.5, 0.5;
  return join({along_x, along_y, point});
}

}  // namespace

TEST(NearestFiber, says_which_way_the_nearer_of_two_runs) {
  const NearestFiber fibers(two_fibers());
  ASSERT_TRUE(fibers.any());
  EXPECT_LT((fibers.direction({0.4, 0, 0.2}) - Vec3::UnitX()).norm(), 1e-12);
  EXPECT_LT((fibers.direction({0.5, 0.4, 0.8}) - Vec3::UnitY()).norm(), 1e-12);
}

TEST(NearestFiber, without_fibers_knows_no_direction) {
  EXPECT_FALSE(NearestFiber(Polylines{}).any());
  EXPECT_EQ(NearestFiber().direction(Vec3::Zero()), Vec3::Zero());
}

}  // namespace gracilis
