#include <gracilis/geometry/sobol_points.hpp>

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <vector>

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

TEST(SobolPoints, of_powers_of_two_are_the_published_direction_numbers) {
  // Joe and Kuo 2008: degree, inner coefficients of the primitive polynomial, first direction numbers; and from these
  // m_k = 2 a_1 m_(k-1) ^ ... ^ 2^(s-1) a_(s-1) m_(k-s+1) ^ 2^s m_(k-s) ^ m_(k-s).
  struct Row {
    int degree;
    unsigned inner;
    std::vector<std::uint64_t> m;
  };
  const std::vector<Row> rows = {{1, 0, {1}},
                                 {2, 1, {1, 3}},
                                 {3, 1, {1, 3, 1}},
                                 {3, 2, {1, 1, 1}},
                                 {4, 1, {1, 1, 3, 3}},
                                 {4, 4, {1, 3, 5, 13}},
                                 {5, 2, {1, 1, 5, 5, 17}},
                                 {5, 4, {1, 1, 5, 5, 5}},
                                 {5, 7, {1, 1, 7, 11, 19}},
                                 {5, 11, {1, 1, 5, 1, 1}},
                                 {5, 13, {1, 1, 1, 3, 11}},
                                 {5, 14, {1, 3, 5, 5, 31}},
                                 {6, 1, {1, 3, 3, 9, 7, 49}},
                                 {6, 13, {1, 1, 1, 15, 21, 21}},
                                 {6, 16, {1, 3, 1, 13, 27, 49}},
                                 {6, 19, {1, 1, 1, 15, 7, 5}},
                                 {6, 22, {1, 3, 1, 15, 13, 25}},
                                 {6, 25, {1, 1, 5, 5, 19, 61}},
                                 {7, 1, {1, 3, 7, 11, 23, 15, 103}},
                                 {7, 4, {1, 3, 7, 13, 13, 15, 69}}};
  for (std::size_t column = 1; column <= rows.size(); ++column) {
    Row row = rows[column - 1];
    while (row.m.size() < 14) {
      const std::size_t k = row.m.size(), degree = static_cast<std::size_t>(row.degree);
      std::uint64_t next = (row.m[k - degree] << degree) ^ row.m[k - degree];
      for (std::size_t i = 1; i < degree; ++i)
        if ((row.inner >> (degree - 1 - i)) & 1u) next ^= row.m[k - i] << i;
      row.m.push_back(next);
    }
    for (std::size_t k = 0; k < 14; ++k) {
      const Real value = sobol_points(1, most_sobol_dimensions, Eigen::Index(1) << k)(0, static_cast<Index>(column));
      EXPECT_EQ(value, static_cast<Real>(row.m[k]) / static_cast<Real>(std::uint64_t{2} << k)) << column << ' ' << k;
    }
  }
  for (std::size_t k = 0; k < 30; ++k)
    EXPECT_EQ(sobol_points(1, 1, Eigen::Index(1) << k)(0, 0), 0.5 / static_cast<Real>(std::uint64_t{1} << k));
}

TEST(SobolPoints, of_a_sum_of_powers_is_their_digits_exclusive_sum) {
  const Eigen::MatrixXd points = sobol_points(64, 5);
  const auto bits = [&](Index row, Index column) { return static_cast<std::uint32_t>(points(row, column) * 64); };
  for (Index column = 0; column < 5; ++column)
    for (const Index row : {3, 13, 42, 63}) {
      std::uint32_t sum = 0;
      for (Index power = 1; power < 64; power *= 2)
        if (row & power) sum ^= bits(power, column);
      EXPECT_EQ(bits(row, column), sum);
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
