#include <gracilis/geometry/solid_grid.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace gracilis {
namespace {

const Vec3 low(0.01, -0.02, 0.03), high(0.05, 0.04, 0.05);

SolidGrid grid_in_box(const TriangleMesh& sheets = {}) {
  const TriangleMesh box = shapes::box(low, high);
  return {box, SignedDistance(box), sheets, 6000};
}

/// A square across the box at this x.
TriangleMesh sheet_at(Real x) {
  return shapes::mesh_of({{x, -0.03, 0.02}, {x, 0.05, 0.02}, {x, 0.05, 0.06}, {x, -0.03, 0.06}},
                         {{0, 1, 2}, {0, 2, 3}});
}

}  // namespace

TEST(SolidGrid, as_many_nodes_lie_inside_as_asked_for_and_know_how_deep) {
  const SolidGrid grid = grid_in_box();
  EXPECT_NEAR(grid.step(), std::cbrt((high - low).prod() / 6000), 1e-12);
  Index inside = 0;
  for (Index n = 0; n < grid.count(); ++n) {
    const Vec3 p = grid.nodes().col(n), out = (low - p).cwiseMax(p - high);
    const Real depth = out.maxCoeff() > 0 ? -out.cwiseMax(0).norm() : -out.maxCoeff();
    EXPECT_NEAR(grid.depths()[static_cast<std::size_t>(n)], depth, 1e-9);
    EXPECT_GT(depth, -1.8 * grid.step() - 1e-9);
    inside += depth > 0;
  }
  EXPECT_NEAR(static_cast<Real>(inside), 6000, 800) << "as far as a step fits into the sides";
}

TEST(SolidGrid, tells_linear_functions_exactly_wherever_one_is_inside) {
  const SolidGrid grid = grid_in_box();
  Points vectors(3, grid.count());
  const Eigen::Matrix3d slope = (Eigen::Matrix3d() << 1, 2, 3, -4, 5, 6, 7, -8, 9).finished();
  for (Index n = 0; n < grid.count(); ++n) vectors.col(n) = slope * grid.nodes().col(n) + Vec3(1, 2, 3);
  for (int i = 0; i <= 10; ++i)
    for (int j = 0; j <= 10; ++j)
      for (int k = 0; k <= 10; ++k) {
        const Vec3 p = low + Vec3(i, j, k).cwiseProduct(high - low) / 10;
        const SolidGrid::Place at = grid.place(p);
        ASSERT_TRUE(at.is_known) << p.transpose();
        EXPECT_LT((at.mean(vectors) - slope * p - Vec3(1, 2, 3)).norm(), 1e-12);
      }
  EXPECT_FALSE(grid.place(high + Vec3::Constant(4 * grid.step())).is_known);
  EXPECT_FALSE(grid.place(low - Vec3(1, 0, 0)).is_known);
  EXPECT_EQ(grid.depth(low - Vec3(1, 0, 0)), -grid.step());
  EXPECT_NEAR(grid.depth((low + high) / 2), 0.01, grid.step());
  EXPECT_NEAR(grid.depth(Vec3(0.03, 0.01, 0.0325)), 0.0025, 1e-9) << "linear under a side";
}

TEST(SolidGrid, joins_every_two_neighbors_once_by_what_of_the_way_lies_inside) {
  const SolidGrid grid = grid_in_box();
  std::set<std::pair<Index, Index>> seen;
  Real crossing = 0;
  for (const SolidGrid::Edge& edge : grid.edges()) {
    EXPECT_NEAR((grid.nodes().col(edge.a) - grid.nodes().col(edge.b)).norm(), grid.step(), 1e-9);
    EXPECT_TRUE(seen.insert(std::minmax(edge.a, edge.b)).second);
    const Real a = grid.depths()[static_cast<std::size_t>(edge.a)], b = grid.depths()[static_cast<std::size_t>(edge.b)];
    if (a >= 0 && b >= 0) {
      EXPECT_EQ(edge.share, 1);
    } else if (a <= 0 && b <= 0) {
      EXPECT_EQ(edge.share, 0.02);
    } else {
      EXPECT_NEAR(edge.share, std::max(0.02, std::max(a, b) / (std::max(a, b) - std::min(a, b))), 1e-12);
      crossing += 1;
    }
  }
  EXPECT_GT(crossing, 100);
  // Within the box a cubic lattice has three times as many edges as nodes, but for its sides.
  const auto within =
      std::count_if(grid.edges().begin(), grid.edges().end(), [](const auto& e) { return e.share == 1; });
  const auto nodes = std::count_if(grid.depths().begin(), grid.depths().end(), [](Real depth) { return depth >= 0; });
  EXPECT_GT(within, 5 * nodes / 2);
  EXPECT_LT(within, 3 * nodes);
}

TEST(SolidGrid, a_sheet_parts_what_lies_on_its_two_sides) {
  const Real x = 0.0303;
  const SolidGrid grid = grid_in_box(sheet_at(x));
  Points side(3, grid.count());
  for (Index n = 0; n < grid.count(); ++n) side.col(n) = Vec3::Constant(grid.nodes()(0, n) < x ? 1 : 2);
  for (const Real off : {0.01, 0.5, 0.9}) {
    for (const Real y : {-0.01, 0.013, 0.02}) {
      EXPECT_NEAR(grid.place({x - off * grid.step(), y, 0.04}).mean(side).x(), 1, 1e-12);
      EXPECT_NEAR(grid.place({x + off * grid.step(), y, 0.04}).mean(side).x(), 2, 1e-12);
    }
  }
  Index cut = 0;
  for (const SolidGrid::Edge& edge : grid.edges()) {
    const bool crosses = (grid.nodes()(0, edge.a) < x) != (grid.nodes()(0, edge.b) < x);
    const Real shallow =
        std::min(grid.depths()[static_cast<std::size_t>(edge.a)], grid.depths()[static_cast<std::size_t>(edge.b)]);
    if (shallow < 0) continue;
    EXPECT_EQ(edge.share, crosses ? 1e-4 : 1.0);
    cut += crosses;
  }
  EXPECT_GT(cut, 100);
}

}  // namespace gracilis
