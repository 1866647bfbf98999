#include <gracilis/anatomy/fibers/fiber_knots.hpp>

#include <gtest/gtest.h>

namespace gracilis {
namespace {

/// A rectangle around the z axis, its sides (m) along x and y turned about z.
SectionMap rectangle(Real width, Real thickness, Real turn, Real z) {
  constexpr Index per_side = 30;
  const std::array<Eigen::Vector2d, 5> corners = {
      Eigen::Vector2d(-1, -1), {1, -1}, {1, 1}, {-1, 1}, Eigen::Vector2d(-1, -1)};
  const Eigen::Matrix3d turned = Eigen::AngleAxisd(turn, Vec3::UnitZ()).toRotationMatrix();
  Points loop(3, 4 * per_side);
  for (Index side = 0; side < 4; ++side)
    for (Index i = 0; i < per_side; ++i) {
      const auto k = static_cast<std::size_t>(side);
      const Eigen::Vector2d p = corners[k] + (corners[k + 1] - corners[k]) * (Real(i) / per_side);
      loop.col(side * per_side + i) = turned * Vec3(width / 2 * p.x(), thickness / 2 * p.y(), z);
    }
  Real aspect = 0;
  return SectionMap::build(loop, square_corners(loop, aspect)).value();
}

/// How far (m) one may go in a direction until the limit is reached.
Real extent(const Eigen::Matrix3d& inverse, const Vec3& direction) {
  return 1 / std::sqrt(direction.dot(inverse * direction));
}

FiberKnots knots_at(const std::vector<Vec3>& places) {
  FiberKnots knots{Points(3, static_cast<Index>(places.size())), {}};
  for (std::size_t i = 0; i < places.size(); ++i) {
    knots.line.col(static_cast<Index>(i)) = places[i];
    knots.extents.emplace_back(static_cast<Real>(i + 1) * Eigen::Matrix3d::Identity());
  }
  return knots;
}

/// Which of `knots_at` are left.
std::vector<int> numbers(const FiberKnots& knots) {
  std::vector<int> found;
  for (const Eigen::Matrix3d& each : knots.extents) found.push_back(static_cast<int>(each(0, 0)) - 1);
  return found;
}

}  // namespace

TEST(FiberKnots, extents_are_half_of_a_section_s_width_and_thickness_and_none_along_the_fibers) {
  for (const Real turn : {0.0, 0.7}) {
    const std::vector<Eigen::Matrix3d> found = inverse_extents({rectangle(0.04, 0.01, turn, 0.1)});
    ASSERT_EQ(found.size(), 3u);
    const Vec3 wide(std::cos(turn), std::sin(turn), 0), thin(-std::sin(turn), std::cos(turn), 0);
    for (const Eigen::Matrix3d& each : found) {
      // 32 points stand for the section.
      EXPECT_NEAR(extent(each, wide), 0.02, 0.001);
      EXPECT_NEAR(extent(each, thin), 0.005, 0.0003);
      EXPECT_NEAR((each * Vec3::UnitZ()).norm(), 0, 1e-6 * each.norm());
      EXPECT_TRUE(each.isApprox(each.transpose()));
    }
  }
}

TEST(FiberKnots, the_ends_have_the_extents_of_the_sections_beside_them) {
  const std::vector<Eigen::Matrix3d> found =
      inverse_extents({rectangle(0.04, 0.01, 0, 0), rectangle(0.03, 0.02, 0, 0.1), rectangle(0.02, 0.012, 0, 0.2)});
  ASSERT_EQ(found.size(), 5u);
  EXPECT_EQ(found[0], found[1]);
  EXPECT_EQ(found[4], found[3]);
  for (const std::size_t k : {1, 2, 3}) EXPECT_NEAR(extent(found[k], Vec3::UnitX()), 0.025 - 0.005 * k, 0.001) << k;
  const std::vector<Eigen::Matrix3d> none = inverse_extents({});
  ASSERT_EQ(none.size(), 2u);
  EXPECT_TRUE(none[0].isZero() && none[1].isZero()) << "nothing is known, nothing is limited";
}

TEST(FiberKnots, a_section_thinner_than_a_micrometer_counts_as_two) {
  const std::vector<Eigen::Matrix3d> found = inverse_extents({rectangle(0.002, 1e-6, 0, 0)});
  EXPECT_NEAR(extent(found[1], Vec3::UnitY()), 1e-6, 1e-8);
  EXPECT_NEAR(extent(found[1], Vec3::UnitX()), 0.001, 5e-5);
}

TEST(FiberKnots, points_from_which_a_fiber_would_turn_back_go_and_the_ends_stay) {
  const auto along_x = [](const std::vector<Real>& places) {
    std::vector<Vec3> points;
    for (const Real x : places) points.emplace_back(x, 0, 0);
    return numbers(without_turning_back(knots_at(points)));
  };
  EXPECT_EQ(along_x({0, 1, 2, 3}), (std::vector{0, 1, 2, 3}));
  EXPECT_EQ(along_x({0, 1, 3, 2, 4}), (std::vector{0, 1, 3, 4})) << "one goes too far";
  EXPECT_EQ(along_x({0, 1, 2, 3, 0.5}), (std::vector{0, 4})) << "all between that go past the end";
  EXPECT_EQ(along_x({0, 1, 2, -1}), (std::vector{0, 3})) << "whatever the end is";
  EXPECT_EQ(along_x({0, -1, 2}), (std::vector{0, 2}));
  EXPECT_EQ(along_x({0}), (std::vector{0}));
  EXPECT_TRUE(along_x({}).empty());
  // Around a corner of 90 degrees nothing turns back, around a sharper one it does.
  EXPECT_EQ(numbers(without_turning_back(knots_at({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}))), (std::vector{0, 1, 2}));
  const FiberKnots sharp = without_turning_back(knots_at({{0, 0, 0}, {1, 0, 0}, {0.9, 1, 0}}));
  EXPECT_EQ(numbers(sharp), (std::vector{0, 2}));
  ASSERT_EQ(sharp.line.cols(), 2);
  EXPECT_EQ(sharp.line.col(1), Vec3(0.9, 1, 0)) << "places go with their extents";
}

TEST(FiberKnots, limits_lie_between_those_of_the_knots_by_the_way) {
  // 1, 2 and 3 at 0, 1 and 3 m; the extents grow with the inverse square of the share.
  const FiberKnots knots = knots_at({{0, 0, 0}, {0, 1, 0}, {2, 1, 0}});
  const std::vector<Eigen::Matrix3d> limits = smoothing_limits(knots, 0.5, 7);
  ASSERT_EQ(limits.size(), 7u);
  const std::vector<Real> wanted = {1, 1.5, 2, 2.25, 2.5, 2.75, 3};
  for (std::size_t i = 0; i < 7; ++i)
    EXPECT_LT((limits[i] - wanted[i] / 0.25 * Eigen::Matrix3d::Identity()).norm(), 1e-12) << i;
  const std::vector<Eigen::Matrix3d> ends = smoothing_limits(knots, 2, 2);
  EXPECT_TRUE(ends[0].isApprox(Eigen::Matrix3d::Identity() / 4));
  EXPECT_TRUE(ends[1].isApprox(Eigen::Matrix3d::Identity() * 3 / 4));
}

TEST(FiberKnots, limits_stay_finite_without_reach_and_where_knots_coincide) {
  const FiberKnots knots = knots_at({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 0, 0}});
  for (const Eigen::Matrix3d& each : smoothing_limits(knots, 0, 5)) {
    EXPECT_TRUE(each.allFinite());
    EXPECT_GE(each(0, 0), 1e12) << "a micrometer's share of the extents";
    EXPECT_LE(each(0, 0), 4e12);
  }
  for (const Eigen::Matrix3d& each : smoothing_limits(knots_at({{1, 1, 1}, {1, 1, 1}}), 1, 3))
    EXPECT_TRUE(each.allFinite());
}

}  // namespace gracilis
