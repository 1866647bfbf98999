#include <gracilis/simulate/moment_arms.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace gracilis {

TEST(MomentArms, of_a_fiber_around_a_cylinder_are_its_radius) {
  // From a point on the fixed body, tangent to a cylinder of radius r around the joint, around it, and off tangentially
  // to a point on the turning body: the wrapped arc grows by r per radian.
  constexpr Real radius = 0.03, fixed = 0.1, moving = 0.15;
  Eigen::VectorXd angle = Eigen::VectorXd::LinSpaced(41, 0.2, 1.6);
  Eigen::MatrixXd length(41, 1);
  for (Index i = 0; i < 41; ++i) {
    const Real between = pi - 0.3 + angle[i];  // from point to point around the joint
    const Real arc = between - std::acos(radius / fixed) - std::acos(radius / moving);
    length(i, 0) =
        std::sqrt(fixed * fixed - radius * radius) + std::sqrt(moving * moving - radius * radius) + radius * arc;
    ASSERT_GT(arc, 0);
  }
  const Eigen::MatrixXd arms = moment_arms(angle, length);
  for (Index i = 0; i < 41; ++i) EXPECT_NEAR(arms(i, 0), -radius, 1e-9) << "lengthens with the angle";
  EXPECT_NEAR(largest_step_per_degree(angle, arms.col(0)), 0, 1e-9);
}

TEST(MomentArms, of_a_straight_line_between_two_bodies_agree_with_its_lever) {
  constexpr Real a = 0.1, b = 0.2;
  const Eigen::VectorXd angle = Eigen::VectorXd::LinSpaced(91, 0.5, 2);
  Eigen::MatrixXd length(91, 2);
  for (Index i = 0; i < 91; ++i) {
    length(i, 0) = std::sqrt(a * a + b * b - 2 * a * b * std::cos(angle[i]));
    length(i, 1) = 2 * length(i, 0);
  }
  const Eigen::MatrixXd arms = moment_arms(angle, length);
  for (Index i = 0; i < 91; ++i) {
    const Real lever = a * b * std::sin(angle[i]) / length(i, 0);  // distance of the line from the joint
    const Real tolerance = i == 0 || i == 90 ? 4e-5 : 2e-5;        // one-sided parabolas err by twice as much
    EXPECT_NEAR(arms(i, 0), -lever, tolerance) << i;
    EXPECT_NEAR(arms(i, 1), -2 * lever, 2 * tolerance) << i;
  }
}

TEST(MomentArms, of_a_parabola_are_exact_also_at_its_ends_and_with_uneven_or_falling_angles) {
  Eigen::VectorXd angle(4);
  angle << 1, 0.9, 0.5, 0.4;
  const Eigen::MatrixXd length = angle.array().square();
  const Eigen::MatrixXd arms = moment_arms(angle, length);
  for (Index i = 0; i < 4; ++i) EXPECT_NEAR(arms(i, 0), -2 * angle[i], 1e-12);
}

TEST(MomentArms, of_two_rows_are_the_quotient_and_of_one_nothing) {
  const Eigen::MatrixXd arms = moment_arms(Eigen::Vector2d(0, 0.5), Eigen::Vector2d(0.2, 0.1));
  EXPECT_NEAR(arms(0, 0), 0.2, 1e-12);
  EXPECT_NEAR(arms(1, 0), 0.2, 1e-12);
  EXPECT_EQ(moment_arms(Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Ones(1, 1))(0, 0), 0);
}

TEST(MomentArms, show_a_jump_as_a_step_per_degree) {
  Eigen::VectorXd angle(3), arms(3);
  angle << 0, radians(2), radians(4);
  arms << 0.01, 0.01, 0.016;
  EXPECT_NEAR(largest_step_per_degree(angle, arms), 0.003, 1e-12);
}

}  // namespace gracilis
