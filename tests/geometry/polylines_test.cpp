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
