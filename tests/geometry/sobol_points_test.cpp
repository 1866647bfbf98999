#include <gracilis/geometry/sobol_points.hpp>

#include <gtest/gtest.h>

#include <set>

namespace gracilis {

TEST(SobolPoints, every_column_has_a_point_in_each_equal_part) {
  const Eigen::MatrixXd points = sobol_points(256, most_sobol_dimensions);
  for (Eigen::Index column = 0; column < points.cols(); ++column) {
    std::set<int> parts;
    for (Eigen::Index row = 0; row < points.rows(); ++row) parts.insert(static_cast<int>(256 * points(row, column)));
    EXPECT_EQ(parts.size(), 256u) << "column " << column;
    EXPECT_EQ(*parts.begin(), 0) << "column " << column;
    EXPECT_EQ(*parts.rbegin(), 255) << "column " << column;
  }
}

TEST(SobolPoints, two_columns_fill_the_square) {
  const Eigen::MatrixXd points = sobol_points(256, 2);
  std::set<std::pair<int, int>> cells;
  for (Eigen::Index row = 0; row < 256; ++row)
    cells.emplace(static_cast<int>(16 * points(row, 0)), static_cast<int>(16 * points(row, 1)));
  EXPECT_EQ(cells.size(), 256u);
}

TEST(SobolPoints, no_two_columns_of_the_first_eight_go_together) {
  const Eigen::MatrixXd points = sobol_points(1024, 8);
  const Eigen::MatrixXd off = points.rowwise() - points.colwise().mean();
  for (Eigen::Index a = 0; a < 8; ++a)
    for (Eigen::Index b = 0; b < a; ++b)
      EXPECT_LT(std::abs(off.col(a).dot(off.col(b)) / (off.col(a).norm() * off.col(b).norm())), 0.02) << a << " " << b;
}

TEST(SobolPoints, a_sequence_goes_on_where_it_was_left) {
  EXPECT_TRUE(sobol_points(5, 3, 7).isApprox(sobol_points(12, 3).bottomRows(5), 0));
}

}  // namespace gracilis
