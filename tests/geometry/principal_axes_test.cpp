#include <gracilis/geometry/principal_axes.hpp>

#include <Eigen/Geometry>

#include <gtest/gtest.h>

namespace gracilis {
namespace {

TEST(PrincipalAxes, of_a_turned_box_are_its_edges_the_shortest_first) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  Points corners(3, 8);
  for (int i = 0; i < 8; ++i)
    corners.col(i) = Vec3(5, -2, 1) + turn * Vec3(i & 1 ? 2 : -2, i & 2 ? 0.5 : -0.5, i & 4 ? 1 : -1);
  const PrincipalAxes axes = spread_of(corners);
  EXPECT_TRUE(axes.values.isApprox(8 * Vec3(0.25, 1, 4), 1e-12));
  EXPECT_NEAR(std::abs(axes.least().dot(turn.col(1))), 1, 1e-12);
  EXPECT_NEAR(std::abs(axes.most().dot(turn.col(0))), 1, 1e-12);
}

TEST(PrincipalAxes, belong_to_their_values) {
  Eigen::Matrix3d symmetric;
  symmetric << 2, -1, 0.5, -1, 3, 0.25, 0.5, 0.25, -1;
  const PrincipalAxes axes = principal_axes(symmetric);
  EXPECT_TRUE((symmetric * axes.directions).isApprox(axes.directions * axes.values.asDiagonal(), 1e-12));
  EXPECT_TRUE((axes.directions.transpose() * axes.directions).isIdentity(1e-12));
}

TEST(PrincipalAxes, of_one_point_have_no_spread) {
  EXPECT_TRUE(spread_of(Vec3(1, 2, 3)).values.isZero(1e-15));
}

}  // namespace
}  // namespace gracilis
