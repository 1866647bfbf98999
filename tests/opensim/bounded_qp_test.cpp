#include <gracilis/opensim/static_optimization/bounded_qp.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gracilis::opensim {

/// Activations of muscles that pull on one coordinate with these moments; within 0 and 1.
static BoundedQp one_moment(std::initializer_list<Real> moments, Real needed) {
  const auto n = static_cast<Eigen::Index>(moments.size());
  BoundedQp problem;
  problem.a = Eigen::Map<const Eigen::RowVectorXd>(moments.begin(), n);
  problem.b = Eigen::VectorXd::Constant(1, needed);
  problem.weights = Eigen::VectorXd::Ones(n);
  problem.centers = problem.lower = Eigen::VectorXd::Zero(n);
  problem.upper = Eigen::VectorXd::Ones(n);
  return problem;
}

TEST(BoundedQp, two_muscles_share_a_moment_as_their_strengths) {
  // KKT: a = moment * needed / (sum of the moments' squares).
  const BoundedQpSolution solution = solve(one_moment({30, 40}, 25));
  ASSERT_TRUE(solution.feasible);
  EXPECT_NEAR(solution.x[0], 0.3, 1e-8);
  EXPECT_NEAR(solution.x[1], 0.4, 1e-8);
}

TEST(BoundedQp, a_muscle_at_its_limit_leaves_the_rest_to_the_other) {
  const BoundedQpSolution solution = solve(one_moment({30, 10}, 35));
  ASSERT_TRUE(solution.feasible);
  EXPECT_NEAR(solution.x[0], 1, 1e-8);  // unbounded it would be 1.05
  EXPECT_NEAR(solution.x[1], 0.5, 1e-7);
}

TEST(BoundedQp, an_antagonist_stays_at_its_lower_limit) {
  BoundedQp problem = one_moment({50, -20}, 10);
  problem.lower = Eigen::Vector2d(0.01, 0.01);
  const BoundedQpSolution solution = solve(problem);
  ASSERT_TRUE(solution.feasible);
  EXPECT_NEAR(solution.x[1], 0.01, 1e-12);
  EXPECT_NEAR(solution.x[0], (10 + 0.2) / 50, 1e-8);
}

TEST(BoundedQp, what_no_muscle_can_give_is_missing) {
  const BoundedQpSolution solution = solve(one_moment({30, 40}, 100));
  EXPECT_FALSE(solution.feasible);
  EXPECT_NEAR(solution.missing[0], 30, 1e-6);
  EXPECT_NEAR(solution.x[0], 1, 1e-12);
}

TEST(BoundedQp, a_row_that_nothing_acts_on_is_missing_as_a_whole) {
  BoundedQp problem = one_moment({30, 40}, 25);
  problem.a.conservativeResize(2, Eigen::NoChange);
  problem.a.row(1).setZero();
  problem.b = Eigen::Vector2d(25, 7);
  const BoundedQpSolution solution = solve(problem);
  EXPECT_FALSE(solution.feasible);
  EXPECT_NEAR(solution.missing[0], 0, 1e-4);
  EXPECT_NEAR(solution.missing[1], 7, 1e-12);
}

TEST(BoundedQp, two_rows_and_an_unlimited_reserve_obey_the_kkt_conditions) {
  BoundedQp problem;
  problem.a.resize(2, 4);
  problem.a << 30, 20, -15, 1, 0, 10, 25, 0;
  problem.b = Eigen::Vector2d(12, 9);
  problem.weights = Eigen::Vector4d(1, 1, 1, 0.5);
  problem.centers = Eigen::Vector4d::Zero();
  problem.lower = Eigen::Vector4d(0, 0, 0, -std::numeric_limits<Real>::infinity());
  problem.upper = Eigen::Vector4d(1, 1, 1, std::numeric_limits<Real>::infinity());
  const BoundedQpSolution solution = solve(problem);
  ASSERT_TRUE(solution.feasible);
  EXPECT_LT((problem.a * solution.x - problem.b).norm(), 1e-5);
  // No entry is at a limit, so the gradient is a combination of the rows.
  const Eigen::VectorXd gradient = problem.weights.cwiseProduct(solution.x);
  const Eigen::VectorXd multipliers = (problem.a * problem.a.transpose()).ldlt().solve(problem.a * gradient);
  EXPECT_LT((problem.a.transpose() * multipliers - gradient).norm(), 1e-6);
  EXPECT_GT(solution.x.head<3>().minCoeff(), 0.01);
}

TEST(BoundedQp, higher_powers_share_more_evenly) {
  // For power p: a_i proportional to moment_i^(1/(p-1)).
  for (const Real power : {1.5, 3.0, 5.0}) {
    const BoundedQpSolution solution = minimize_powers(one_moment({30, 40}, 25), power);
    ASSERT_TRUE(solution.feasible);
    const Real first = std::pow(30, 1 / (power - 1)), second = std::pow(40, 1 / (power - 1));
    const Real factor = 25 / (30 * first + 40 * second);
    EXPECT_NEAR(solution.x[0], factor * first, 1e-6) << power;
    EXPECT_NEAR(solution.x[1], factor * second, 1e-6) << power;
  }
}

/// A strong entry in both rows and a weak one in the first alone: what the weak one must do is told exactly.
TEST(BoundedQp, rows_that_say_nearly_the_same_are_met) {
  BoundedQp problem;
  problem.a.resize(2, 2);
  problem.a << 400, 1, 390, 0;
  problem.b = Eigen::Vector2d(30, 15);
  problem.weights = Eigen::Vector2d::Ones();
  problem.centers = Eigen::Vector2d::Zero();
  problem.lower = Eigen::Vector2d(0, -1e9);
  problem.upper = Eigen::Vector2d(1, 1e9);
  const BoundedQpSolution solution = solve(problem);
  EXPECT_TRUE(solution.feasible);
  EXPECT_NEAR(solution.x[0], 15.0 / 390, 1e-7);
  EXPECT_NEAR(solution.x[1], 30 - 400 * 15.0 / 390, 1e-4);
}

}  // namespace gracilis::opensim
