#include <gracilis/geometry/rbf_feature_centers.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <set>

namespace gracilis {
namespace {

using Node = std::pair<Index, Index>;
using Nodes = std::set<Node>;

/// Heights at so many nodes, 0.5 m apart, by the numbers of a node.
HeightField height_field(Index columns, Index rows, const std::function<Real(Index, Index)>& height) {
  HeightField field;
  field.columns = columns, field.rows = rows, field.step = 0.5;
  field.heights.resize(columns * rows);
  for (Index j = 0; j < rows; ++j)
    for (Index i = 0; i < columns; ++i) field.heights[j * columns + i] = height(i, j);
  return field;
}

HeightField by_chance(unsigned seed) {
  std::mt19937 chance(seed);
  std::uniform_real_distribution<Real> uniform(-1, 1);
  return height_field(17, 12, [&](Index, Index) { return uniform(chance); });
}

Nodes numbers(const HeightField& field, const Points& points) {
  Nodes found;
  for (Index k = 0; k < points.cols(); ++k) {
    EXPECT_EQ(points(2, k), 0);
    const auto i = static_cast<Index>(std::lround(points(0, k) / field.step)),
               j = static_cast<Index>(std::lround(points(1, k) / field.step));
    EXPECT_LT((points.col(k) - field.node(i, j)).norm(), 1e-12);
    EXPECT_TRUE(found.emplace(i, j).second);
  }
  return found;
}

/// Heights of the eight around a node, in a ring.
std::vector<Real> around(const HeightField& field, Index i, Index j) {
  return {field.at(i + 1, j), field.at(i + 1, j + 1), field.at(i, j + 1), field.at(i - 1, j + 1),
          field.at(i - 1, j), field.at(i - 1, j - 1), field.at(i, j - 1), field.at(i + 1, j - 1)};
}

Nodes nodes_where(const HeightField& field, Index border, const std::function<bool(Index, Index)>& holds) {
  Nodes found;
  for (Index j = border; j < field.rows - border; ++j)
    for (Index i = border; i < field.columns - border; ++i)
      if (holds(i, j)) found.emplace(i, j);
  return found;
}

Real half_laplacian(const HeightField& field, Index i, Index j) {
  const bool is_inner = i > 0 && j > 0 && i + 1 < field.columns && j + 1 < field.rows;
  if (!is_inner) return 0;
  const Real along = field.at(i + 1, j) - 2 * field.at(i, j) + field.at(i - 1, j),
             across = field.at(i, j + 1) - 2 * field.at(i, j) + field.at(i, j - 1);
  return (along + across) / (2 * field.step * field.step);
}

}  // namespace

TEST(HeightField, nodes_go_row_by_row) {
  const HeightField field = height_field(3, 2, [](Index i, Index j) { return 10.0 * j + i; });
  EXPECT_EQ(field.at(2, 1), 12);
  const Points nodes = field.nodes();
  ASSERT_EQ(nodes.cols(), 6);
  EXPECT_EQ(Vec3(nodes.col(2)), Vec3(1, 0, 0));
  EXPECT_EQ(Vec3(nodes.col(3)), Vec3(0, 0.5, 0));
  EXPECT_EQ(field.box().min(), Vec3::Zero());
  EXPECT_EQ(field.box().max(), Vec3(1, 0.5, 0));
}

TEST(FeatureCenters, extrema_are_all_inner_nodes_above_or_below_all_eight_around_them) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const HeightField field = by_chance(seed);
    const Nodes expected = nodes_where(field, 1, [&](Index i, Index j) {
      const std::vector<Real> ring = around(field, i, j);
      const Real here = field.at(i, j);
      return *std::min_element(ring.begin(), ring.end()) > here || *std::max_element(ring.begin(), ring.end()) < here;
    });
    EXPECT_GT(expected.size(), 10u);
    EXPECT_EQ(numbers(field, extremum_centers(field)), expected) << seed;
  }
  // One of two nodes of one height is none.
  EXPECT_EQ(
      extremum_centers(height_field(6, 5, [](Index i, Index j) { return j == 2 && (i == 2 || i == 3) ? 1.0 : 0; }))
          .cols(),
      0);
}

TEST(FeatureCenters, of_curvature_are_its_extrema_and_saddles) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const HeightField field = by_chance(seed);
    const HeightField bends = height_field(17, 12, [&](Index i, Index j) { return half_laplacian(field, i, j); });
    const Nodes expected = nodes_where(field, 2, [&](Index i, Index j) {
      int changes = 0;
      const std::vector<Real> ring = around(bends, i, j);
      for (std::size_t k = 0; k < 8; ++k) changes += (ring[k] > bends.at(i, j)) != (ring[(k + 1) % 8] > bends.at(i, j));
      return changes != 2;
    });
    EXPECT_GT(expected.size(), 10u);
    EXPECT_EQ(numbers(field, curvature_centers(field)), expected) << seed;
  }
  EXPECT_EQ(curvature_centers(height_field(9, 9, [](Index i, Index j) { return 0.3 * i - 0.7 * j; })).cols(), 0);
}

TEST(FeatureCenters, inflections_are_nodes_less_curved_than_two_opposite_neighbors_of_different_sign) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const HeightField field = by_chance(seed);
    const Nodes expected = nodes_where(field, 2, [&](Index i, Index j) {
      const auto changes = [&](Real before, Real after) {
        return before * after < 0 &&
               std::abs(half_laplacian(field, i, j)) <= std::min(std::abs(before), std::abs(after));
      };
      return changes(half_laplacian(field, i - 1, j), half_laplacian(field, i + 1, j)) ||
             changes(half_laplacian(field, i, j - 1), half_laplacian(field, i, j + 1));
    });
    EXPECT_GT(expected.size(), 10u);
    EXPECT_EQ(numbers(field, inflection_centers(field)), expected) << seed;
  }
  EXPECT_EQ(inflection_centers(height_field(9, 9, [](Index i, Index j) { return 0.3 * i - 0.7 * j; })).cols(), 0)
      << "rounding of a plane does not count";
}

TEST(FeatureCenters, edges_run_where_a_step_is_steepest_whichever_way_it_faces) {
  for (int octant = 0; octant < 8; ++octant) {
    const Real across_x = std::cos(pi / 4 * octant), across_y = std::sin(pi / 4 * octant);
    const HeightField field = height_field(
        15, 15, [&](Index i, Index j) { return std::tanh((across_x * (i - 7) + across_y * (j - 7)) / 1.5); });
    const Nodes found = numbers(field, edge_centers(field));
    for (Index k = -3; k <= 3; ++k) {
      // Along the step, and one node to either side.
      const auto along_i = static_cast<Index>(std::lround(-across_y)),
                 along_j = static_cast<Index>(std::lround(across_x));
      const auto out_i = static_cast<Index>(std::lround(across_x)), out_j = static_cast<Index>(std::lround(across_y));
      EXPECT_TRUE(found.contains({7 + k * along_i, 7 + k * along_j})) << octant << ' ' << k;
      EXPECT_FALSE(found.contains({7 + k * along_i + out_i, 7 + k * along_j + out_j})) << octant << ' ' << k;
      EXPECT_FALSE(found.contains({7 + k * along_i - out_i, 7 + k * along_j - out_j})) << octant << ' ' << k;
    }
  }
}

TEST(FeatureCenters, a_weak_edge_counts_where_it_hangs_together_with_a_strong_one) {
  // Steps across the columns 6 and 16, whose height falls from row to row: the first from 1 to 0.1, the second is 0.45
  // of the highest everywhere.
  const auto first = [](Index j) { return 1 - 0.9 * j / 24.0; };
  const HeightField field = height_field(
      23, 25, [&](Index i, Index j) { return first(j) * std::tanh(i - 6.0) + 0.45 * std::tanh(i - 16.0); });
  const auto count_in = [&](const Nodes& nodes, Index column) {
    Index count = 0;
    for (const Node& node : nodes) count += node.first == column;
    return count;
  };
  const Nodes found = numbers(field, edge_centers(field, 0.3, 0.6)),
              strong = numbers(field, edge_centers(field, 0.6, 0.6)),
              all = numbers(field, edge_centers(field, 0.3, 0.3));
  EXPECT_EQ(count_in(found, 16), 0) << "nowhere above 0.6";
  EXPECT_EQ(count_in(strong, 16), 0);
  EXPECT_EQ(count_in(all, 16), 21) << "all inner rows but those beside the border";
  // The steepest node is in row 1, with 0.9625 of the height.
  Index above_low = 0, above_high = 0;
  for (Index j = 2; j < 23; ++j) above_low += first(j) > 0.3 * first(1), above_high += first(j) > 0.6 * first(1);
  EXPECT_NEAR(count_in(found, 6), above_low, 1);
  EXPECT_NEAR(count_in(strong, 6), above_high, 1);
  EXPECT_GT(above_low, above_high + 4);
}

TEST(FeatureCenters, borders_go_around_the_field_evenly) {
  const Points found = border_centers(height_field(5, 3, [](Index, Index) { return 0.0; }), 1);
  ASSERT_EQ(found.cols(), 8);
  const Real x[] = {0, 1, 2, 2, 2, 1, 0, 0}, y[] = {0, 0, 0, 0.5, 1, 1, 1, 0.5};
  for (Index k = 0; k < 8; ++k) EXPECT_LT((found.col(k) - Vec3(x[k], y[k], 0)).norm(), 1e-15) << k;
}

}  // namespace gracilis
