#include <gracilis/geometry/polylines.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace gracilis {

static Points corner() {
  Points line(3, 3);
  line << 0, 3, 3, 0, 0, 4, 0, 0, 0;
  return line;
}

TEST(Polylines, know_their_lines_and_lengths) {
  const Polylines lines = join({corner(), corner().leftCols(2), corner().leftCols(1)});
  EXPECT_EQ(lines.count(), 3);
  EXPECT_EQ(lines.size(1), 2);
  EXPECT_EQ(lines.line(0), corner());
  EXPECT_EQ(polyline_lengths(lines), (std::vector<Real>{7, 3, 0}));
  Polylines grown;
  grown.append(corner());
  grown.append(corner().leftCols(2));
  EXPECT_EQ(grown.count(), 2);
  EXPECT_EQ(grown.line(1), corner().leftCols(2));
}

TEST(Polylines, are_resampled_at_equal_distances_along_them_with_their_ends_in_place) {
  const Points even = resampled(corner(), 14);
  ASSERT_EQ(even.cols(), 15);
  EXPECT_EQ(even.col(0), corner().col(0));
  EXPECT_EQ(even.col(14), corner().col(2));
  EXPECT_NEAR((even.col(6) - Vec3(3, 0, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((even.col(9) - Vec3(3, 1.5, 0)).norm(), 0, 1e-12);
  EXPECT_EQ(resampled(corner().leftCols(1), 2), corner().leftCols(1).replicate(1, 3)) << "a single point";
}

TEST(Polylines, of_many_as_many_as_wanted_are_spread_over_their_numbers) {
  EXPECT_EQ(spread_numbers(10, 5), (std::vector<Index>{0, 2, 4, 6, 8}));
  EXPECT_EQ(spread_numbers(10, 4), (std::vector<Index>{0, 2, 5, 7}));
  EXPECT_EQ(spread_numbers(3, 7), (std::vector<Index>{0, 1, 2}));
  EXPECT_TRUE(spread_numbers(0, 7).empty());
  EXPECT_TRUE(spread_numbers(7, 0).empty());
  const Polylines lines = join({corner(), corner().leftCols(2), corner().leftCols(1), corner().rightCols(2)});
  const Polylines two = spread_lines(lines, 2);
  ASSERT_EQ(two.count(), 2);
  EXPECT_EQ(two.line(0), corner());
  EXPECT_EQ(two.line(1), corner().leftCols(1));
}

TEST(Polylines, know_how_far_along_their_points_are_and_what_lies_there) {
  EXPECT_EQ(distances_along(corner()), (std::vector<Real>{0, 3, 7}));
  EXPECT_EQ(polyline_length(corner()), 7);
  const Points found = points_along(corner(), {-1, 0, 1, 3, 5, 7, 9});
  const Points expected = (Points(3, 7) << 0, 0, 1, 3, 3, 3, 3, 0, 0, 0, 0, 2, 4, 4, 0, 0, 0, 0, 0, 0, 0).finished();
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_EQ(points_along(corner().leftCols(1), {0, 2}), Points::Zero(3, 2));
  Points doubled(3, 4);
  doubled << 0, 0, 2, 2, 0, 0, 0, 0, 0, 0, 0, 0;
  EXPECT_LT((points_along(doubled, {0, 1, 2}) - (Points(3, 3) << 0, 1, 2, 0, 0, 0, 0, 0, 0).finished()).norm(), 1e-15);
}

TEST(Polylines, are_as_far_from_a_point_as_the_nearest_place_on_any_segment) {
  Points line(3, 4);
  line << 0, 1, 1, 1, 0, 0, 0, 2, 0, 0, 0, 0;  // one segment has no length
  EXPECT_DOUBLE_EQ(distance_to_polyline(line, {0.5, -0.3, 0.4}), 0.5) << "beside the first";
  EXPECT_DOUBLE_EQ(distance_to_polyline(line, {-3, -4, 0}), 5) << "before its beginning";
  EXPECT_DOUBLE_EQ(distance_to_polyline(line, {1, 2, 0.25}), 0.25) << "at its end";
  EXPECT_EQ(distance_to_polyline(line, {1, 1.5, 0}), 0);
  EXPECT_TRUE(std::isinf(distance_to_polyline(line.leftCols(1), Vec3::Zero()))) << "no segment";
}

TEST(CentripetalSpline, passes_through_its_knots_and_keeps_to_a_straight_line) {
  const Points smooth = centripetal_spline(corner(), 8);
  ASSERT_EQ(smooth.cols(), 17);
  for (Index k = 0; k < 3; ++k) EXPECT_NEAR((smooth.col(8 * k) - corner().col(k)).norm(), 0, 1e-12);
  Points straight(3, 4);
  straight << 0, 1, 5, 6, 0, 0, 0, 0, 0, 0, 0, 0;
  const Points line = centripetal_spline(straight, 5);
  for (Index i = 1; i < line.cols(); ++i) {
    EXPECT_GT(line(0, i), line(0, i - 1)) << "no cusps, whatever the spacing";
    EXPECT_NEAR(line.col(i).tail<2>().norm(), 0, 1e-12);
  }
}

TEST(CentripetalSpline, is_the_cubic_whose_slopes_are_those_of_the_parabolas_through_three_knots) {
  Points knots(3, 4);
  knots << 0, 1, 3, 3.5, 0, 2, 1, 4, 0, 0.5, -1, 2;
  const Index pieces = 6;
  const Points line = centripetal_spline(knots, pieces);
  ASSERT_EQ(line.cols(), 3 * pieces + 1);
  std::vector<Real> times = {0};  // roots of the ways between knots
  for (Index k = 1; k < 4; ++k) times.push_back(times.back() + std::sqrt((knots.col(k) - knots.col(k - 1)).norm()));
  const auto step = [&](std::size_t k) -> Vec3 {
    const auto at = static_cast<Index>(k);
    return (knots.col(at + 1) - knots.col(at)) / (times[k + 1] - times[k]);
  };
  // At an inner knot the parabola's slope; beyond an end the line goes on as its mirror image, straight.
  const auto slope = [&](std::size_t k) -> Vec3 {
    if (k == 0) return step(0);
    if (k == 3) return step(2);
    const Real before = times[k] - times[k - 1], after = times[k + 1] - times[k];
    return (after * step(k - 1) + before * step(k)) / (before + after);
  };
  for (std::size_t k = 0; k < 3; ++k)
    for (Index i = 0; i < pieces; ++i) {
      const Real t = static_cast<Real>(i) / pieces, width = times[k + 1] - times[k];
      const auto at = static_cast<Index>(k);
      const Vec3 expected = (1 + 2 * t) * (1 - t) * (1 - t) * knots.col(at) + t * t * (3 - 2 * t) * knots.col(at + 1) +
                            width * (t * (1 - t) * (1 - t) * slope(k) + t * t * (t - 1) * slope(k + 1));
      EXPECT_LT((line.col(at * pieces + i) - expected).norm(), 1e-12) << k << ' ' << i;
    }
}

TEST(CentripetalSpline, is_close_to_a_circle_through_points_of_it) {
  Points knots(3, 9);
  for (Index i = 0; i < 9; ++i) knots.col(i) = Vec3(std::cos(pi * i / 8), std::sin(pi * i / 8), 0);
  const Points arc = centripetal_spline(knots, 10).middleCols(10, 61);  // without the spans at the ends
  for (Index i = 0; i < arc.cols(); ++i) EXPECT_NEAR(arc.col(i).norm(), 1, 1e-3);
}

TEST(CentripetalSpline, takes_knots_that_coincide_once) {
  Points knots(3, 4);
  knots << 0, 1, 1, 2, 0, 0, 0, 1, 0, 0, 0, 0;
  const Points line = centripetal_spline(knots, 4);
  EXPECT_EQ(line.cols(), 9);
  EXPECT_TRUE(line.allFinite());
}

}  // namespace gracilis
