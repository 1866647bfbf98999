#include <gracilis/simulate/arm_comparison.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gracilis {
namespace {

/// Arms that grow by `slope` (m/rad) from `at_zero`, every 10 degrees.
ArmCurve line(Real at_zero, Real slope, Real from, Real to) {
  ArmCurve curve{"muscle", "", "line"};
  for (Real angle = from; angle <= to; angle += 10) {
    curve.angles.push_back(radians(angle));
    curve.arms.push_back(at_zero + slope * radians(angle));
  }
  return curve;
}

std::vector<Real> every_two_degrees(Real from, Real to) {
  std::vector<Real> angles;
  for (Real angle = from; angle <= to; angle += 2) angles.push_back(radians(angle));
  return angles;
}

TEST(ArmComparison, of_arms_with_themselves_is_zero_between_the_angles_of_the_reference_too) {
  const std::vector<Real> angles = every_two_degrees(-20, 40);
  std::vector<Real> arms;
  for (const Real angle : angles) arms.push_back(0.03 - 0.01 * angle);
  const ArmComparison comparison = compare_arms(angles, arms, line(0.03, -0.01, -10, 30));
  EXPECT_EQ(comparison.angles, 21);
  EXPECT_NEAR(comparison.from, radians(-10), 1e-12);
  EXPECT_NEAR(comparison.to, radians(30), 1e-12);
  EXPECT_NEAR(comparison.rms, 0, 1e-12);
  EXPECT_NEAR(comparison.largest, 0, 1e-12);
  EXPECT_NEAR(comparison.slope, -0.01, 1e-12);
  EXPECT_NEAR(comparison.reference_slope, -0.01, 1e-12);
}

TEST(ArmComparison, tells_an_offset_and_an_opposite_slope) {
  const std::vector<Real> angles = every_two_degrees(-30, 30);
  std::vector<Real> offset, opposite;
  for (const Real angle : angles) offset.push_back(0.035 - 0.01 * angle), opposite.push_back(0.03 + 0.01 * angle);
  const ArmCurve reference = line(0.03, -0.01, -30, 30);
  EXPECT_NEAR(compare_arms(angles, offset, reference).rms, 0.005, 1e-12);
  EXPECT_NEAR(compare_arms(angles, offset, reference).largest, 0.005, 1e-12);
  EXPECT_NEAR(compare_arms(angles, opposite, reference).slope, 0.01, 1e-12);
  EXPECT_NEAR(compare_arms(angles, opposite, reference).largest, 0.02 * radians(30), 1e-12);
}

TEST(ArmComparison, descending_angles_tell_the_same) {
  std::vector<Real> angles = every_two_degrees(-30, 30), arms;
  for (const Real angle : angles) arms.push_back(0.02 + angle * angle);
  const ArmCurve reference = line(0.03, -0.01, -30, 30);
  const ArmComparison ascending = compare_arms(angles, arms, reference);
  std::reverse(angles.begin(), angles.end()), std::reverse(arms.begin(), arms.end());
  const ArmComparison descending = compare_arms(angles, arms, reference);
  EXPECT_NEAR(ascending.rms, descending.rms, 1e-12);
  EXPECT_NEAR(ascending.slope, descending.slope, 1e-12);
  EXPECT_EQ(ascending.angles, descending.angles);
}

TEST(ArmComparison, ranges_without_a_common_angle_compare_nothing) {
  const ArmComparison comparison =
      compare_arms(every_two_degrees(50, 60), std::vector<Real>(6, 0.01), line(0, 0, 0, 40));
  EXPECT_EQ(comparison.angles, 0);
  EXPECT_EQ(comparison.rms, 0);
  EXPECT_TRUE(std::isnan(comparison.slope));
  EXPECT_EQ(compare_arms({}, {}, line(0, 0, 0, 40)).angles, 0);
  EXPECT_EQ(compare_arms({0}, {0.01}, {}).angles, 0);
}

TEST(ArmComparison, inside_the_band_of_all_curves_the_distance_is_zero) {
  const std::vector<Real> angles = every_two_degrees(0, 20);
  const std::vector<ArmCurve> models = {line(0.02, 0, -20, 40), line(0.03, 0, 0, 60)};
  EXPECT_EQ(mean_distance_from_band(angles, std::vector<Real>(angles.size(), 0.025), models), 0);
  EXPECT_NEAR(mean_distance_from_band(angles, std::vector<Real>(angles.size(), 0.034), models), 0.004, 1e-12);
  EXPECT_NEAR(mean_distance_from_band(angles, std::vector<Real>(angles.size(), -0.01), models), 0.03, 1e-12);
}

TEST(ArmComparison, bounds_of_a_curve_widen_the_band) {
  ArmCurve measured = line(0.02, 0, 0, 20);
  measured.low.assign(measured.arms.size(), 0.01);
  measured.high.assign(measured.arms.size(), 0.04);
  EXPECT_EQ(mean_distance_from_band({radians(5)}, {0.038}, {measured}), 0);
  EXPECT_NEAR(mean_distance_from_band({radians(5)}, {0.042}, {measured}), 0.002, 1e-12);
}

TEST(ArmComparison, a_band_without_a_common_angle_has_no_distance) {
  EXPECT_TRUE(std::isnan(mean_distance_from_band({radians(5)}, {0.02}, {})));
  EXPECT_TRUE(std::isnan(mean_distance_from_band({radians(5)}, {0.02}, {line(0, 0, 10, 20), line(0, 0, 0, 20)})));
}

}  // namespace
}  // namespace gracilis
