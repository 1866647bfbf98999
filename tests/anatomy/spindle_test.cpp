#include <gracilis/anatomy/sections/spindle.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace gracilis {
namespace {

/// About 60 ml in fibers of 10 cm, with a tendon 3 mm thick.
MuscleSize some_size() {
  MuscleSize size;
  size.max_isometric_force = 300;
  size.optimal_fiber = 0.1;
  size.pennation = radians(20);
  return size;
}

Eigen::VectorXd positions_from(Real begin, Real end) { return Eigen::VectorXd::LinSpaced(2001, begin, end); }

/// Of the round body with these radii, by the rule of trapezes.
Real volume_between(const Eigen::VectorXd& positions, const Eigen::VectorXd& radii, Real begin, Real end) {
  Real volume = 0;
  for (Index i = 1; i < positions.size(); ++i)
    if (positions[i - 1] > begin - 1e-9 && positions[i] < end + 1e-9)
      volume += pi / 2 * (radii[i] * radii[i] + radii[i - 1] * radii[i - 1]) * (positions[i] - positions[i - 1]);
  return volume;
}

}  // namespace

TEST(Spindle, sizes_follow_from_force_and_fiber) {
  const MuscleSize size = some_size();
  EXPECT_NEAR(muscle_volume(size), 300 / 6.1e5 * 0.1 / std::cos(pi / 9), 1e-12);
  const Real radius = tendon_radius(size);
  EXPECT_NEAR(pi * radius * radius * size.tendon_stress, size.max_isometric_force, 1e-9);
}

TEST(Spindle, tendons_have_their_own_radius_and_the_belly_between_them_the_muscles_volume) {
  const MuscleSize size = some_size();
  const Eigen::VectorXd positions = positions_from(0.05, 0.35);
  const Eigen::VectorXd radii = spindle_radii(size, positions, 0.1, 0.05);
  for (Index i = 0; i < positions.size(); ++i) {
    if (positions[i] < 0.1 - 1e-9 || positions[i] > 0.25 + 1e-9)
      EXPECT_NEAR(radii[i], tendon_radius(size), 1e-12) << positions[i];
    else
      EXPECT_GE(radii[i], tendon_radius(size) - 1e-12) << positions[i];
  }
  // A thousand trapezes of a sine err by a millionth.
  EXPECT_NEAR(volume_between(positions, radii, 0.1, 0.25) / muscle_volume(size), 1, 3e-6);
}

TEST(Spindle, the_belly_is_a_sine_between_the_tendons_wherever_the_line_begins) {
  const MuscleSize size = some_size();
  for (const Real begin : {-0.2, 0.0, 0.05}) {
    const Eigen::VectorXd positions = positions_from(begin, begin + 0.3);
    const Eigen::VectorXd radii = spindle_radii(size, positions, 0.1, 0.05);
    // ∫ π (r + s sin)² over the belly is its length times π (r² + 4 r s / π + s² / 2).
    const Real r = tendon_radius(size), length = 0.15, share = muscle_volume(size) / (pi * length);
    const Real swelling = -4 * r / pi + std::sqrt(16 * r * r / (pi * pi) - 2 * (r * r - share));
    for (Index i = 0; i < positions.size(); ++i) {
      const Real along = (positions[i] - begin - 0.05) / length;
      const Real expected = along < 0 || along > 1 ? r : r + swelling * std::sin(pi * along);
      EXPECT_NEAR(radii[i], expected, 1e-6) << begin << ' ' << positions[i];
    }
  }
}

TEST(Spindle, a_fifth_of_the_line_is_belly_however_long_the_tendons_are_and_no_thicker_than_half_its_length) {
  MuscleSize size = some_size();
  const Eigen::VectorXd positions = positions_from(0, 0.1);
  const Eigen::VectorXd radii = spindle_radii(size, positions, 0.3, 0.1);  // share 0.2: 60 mm and 20 mm
  Index thickest = 0;
  radii.maxCoeff(&thickest);
  EXPECT_NEAR(positions[thickest], 0.03, 1e-4);
  EXPECT_NEAR(radii[400], tendon_radius(size), 1e-9);
  EXPECT_NEAR(radii[800], tendon_radius(size), 1e-9);
  EXPECT_NEAR(radii[thickest] - tendon_radius(size), 0.01, 1e-4) << "60 ml do not go into 20 mm";
}

}  // namespace gracilis
