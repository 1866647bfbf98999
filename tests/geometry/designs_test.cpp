#include <gracilis/geometry/halton.hpp>
#include <gracilis/geometry/latin_hypercube.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gracilis {

TEST(Halton, points_are_the_mirrored_digits_of_their_numbers) {
  const Eigen::MatrixXd points = halton_points(9, 3);
  const Real twos[] = {1.0 / 2, 1.0 / 4, 3.0 / 4, 1.0 / 8, 5.0 / 8, 3.0 / 8, 7.0 / 8, 1.0 / 16, 9.0 / 16};
  const Real threes[] = {1.0 / 3, 2.0 / 3, 1.0 / 9, 4.0 / 9, 7.0 / 9, 2.0 / 9, 5.0 / 9, 8.0 / 9, 1.0 / 27};
  for (Index i = 0; i < 9; ++i) {
    EXPECT_NEAR(points(i, 0), twos[i], 1e-15);
    EXPECT_NEAR(points(i, 1), threes[i], 1e-15);
  }
  EXPECT_NEAR(points(5, 2), 1.0 / 5 + 1.0 / 25, 1e-15);
}

TEST(Halton, every_column_fills_all_parts_of_its_base_alike) {
  const int bases[] = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53};
  for (Index column = 0; column < 16; ++column) {
    const int base = bases[column];
    const Eigen::MatrixXd points = halton_points(base * base, 16);
    std::vector<int> counts(static_cast<std::size_t>(base), 0);
    for (Index i = 0; i + 1 < base * base; ++i)
      ++counts[static_cast<std::size_t>(std::floor(points(i, column) * base + 1e-9))];
    // The point of number 0 is left out, and the last one of these begins anew.
    EXPECT_EQ(counts[0], base - 1) << base;
    EXPECT_EQ(std::count(counts.begin(), counts.end(), base), base - 1) << base;
  }
}

TEST(LatinHypercube, every_column_has_one_point_in_the_middle_of_each_part) {
  const Eigen::MatrixXd points = latin_hypercube(17, 4, 5);
  for (Index column = 0; column < 4; ++column) {
    Eigen::VectorXd sorted = points.col(column);
    std::sort(sorted.begin(), sorted.end());
    for (Index i = 0; i < 17; ++i) EXPECT_NEAR(sorted[i], (i + 0.5) / 17, 1e-15);
  }
  EXPECT_NE(points.col(0), points.col(1));
  EXPECT_EQ(points, latin_hypercube(17, 4, 5));
  EXPECT_NE(points, latin_hypercube(17, 4, 6));
}

TEST(LatinHypercube, all_orders_come_as_often) {
  std::mt19937_64 random(1);
  std::vector<int> seen(6, 0);
  for (int i = 0; i < 6000; ++i) {
    const std::vector<Index> order = shuffled_order(3, random);
    ++seen[static_cast<std::size_t>(2 * order[0] + (order[1] > order[2] ? 1 : 0))];
  }
  for (const int count : seen) EXPECT_NEAR(count, 1000, 150);  // five standard deviations
  EXPECT_TRUE(shuffled_order(0, random).empty());
}

}  // namespace gracilis
