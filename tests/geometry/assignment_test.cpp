#include <gracilis/geometry/assignment.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace gracilis {

static Real cost_of(const Eigen::MatrixXd& costs, const std::vector<Index>& columns) {
  Real sum = 0;
  for (std::size_t i = 0; i < columns.size(); ++i) sum += costs(static_cast<Index>(i), columns[i]);
  return sum;
}

TEST(CheapestAssignment, is_the_cheapest_of_all_permutations) {
  std::mt19937 random(1);
  std::uniform_real_distribution<Real> value(-1, 1);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::MatrixXd costs = Eigen::MatrixXd::NullaryExpr(6, 6, [&] { return value(random); });
    std::vector<Index> order(6);
    std::iota(order.begin(), order.end(), 0);
    Real least = cost_of(costs, order);
    while (std::next_permutation(order.begin(), order.end())) least = std::min(least, cost_of(costs, order));
    std::vector<Index> found = cheapest_assignment(costs);
    EXPECT_NEAR(cost_of(costs, found), least, 1e-12);
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, (std::vector<Index>{0, 1, 2, 3, 4, 5}));
  }
}

TEST(CheapestAssignment, of_nothing_is_empty) { EXPECT_TRUE(cheapest_assignment(Eigen::MatrixXd(0, 0)).empty()); }

}  // namespace gracilis
