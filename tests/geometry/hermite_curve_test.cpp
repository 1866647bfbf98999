#include <gracilis/geometry/hermite_curve.hpp>

#include <gtest/gtest.h>

namespace gracilis {
namespace {

Real cubic(Real x) { return 2 + x * (1 + x * (-3 + x)); }
Real slope_of_cubic(Real x) { return 1 + x * (-6 + 3 * x); }

}  // namespace

TEST(HermiteCurve, through_the_values_and_slopes_of_a_cubic_is_that_cubic_between_its_ends) {
  HermiteCurve curve;
  for (const Real knot : {-1.0, 0.5, 3.0}) {
    curve.knots.push_back(knot);
    curve.values.push_back(cubic(knot));
    curve.slopes.push_back(slope_of_cubic(knot));
  }
  for (Real x = -1; x <= 3; x += 0.125) EXPECT_NEAR(value_at(curve, x), cubic(x), 1e-12) << x;
  EXPECT_NEAR(value_at(curve, -3), cubic(-1) - 2 * slope_of_cubic(-1), 1e-12) << "straight beyond";
  EXPECT_NEAR(value_at(curve, 5), cubic(3) + 2 * slope_of_cubic(3), 1e-12);
}

TEST(HermiteCurve, a_knot_that_stands_twice_is_a_bend) {
  const HermiteCurve curve{{0, 1, 1, 3}, {0, 2, 2, 0}, {2, 2, -1, -1}};
  EXPECT_NEAR(value_at(curve, 0.25), 0.5, 1e-15);
  EXPECT_NEAR(value_at(curve, 1), 2, 1e-15);
  EXPECT_NEAR(value_at(curve, 2.5), 0.5, 1e-15);
}

TEST(HermiteCurve, of_one_knot_is_straight_and_of_none_zero) {
  EXPECT_NEAR(value_at({{2}, {5}, {0.5}}, 4), 6, 1e-15);
  EXPECT_NEAR(value_at({{2}, {5}, {0.5}}, 0), 4, 1e-15);
  EXPECT_EQ(value_at({}, 1), 0);
}

}  // namespace gracilis
