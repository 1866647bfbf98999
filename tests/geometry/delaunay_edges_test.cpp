#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/delaunay_edges.hpp>

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <algorithm>
#include <limits>
#include <random>
#include <set>

namespace gracilis {
namespace {

using Edges = std::vector<std::array<Index, 2>>;

Points scattered_points(Index count, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<Real> uniform(-1, 1);
  Points points(3, count);
  for (Index i = 0; i < count; ++i) points.col(i) = Vec3(uniform(generator), uniform(generator), uniform(generator));
  return points;
}

/// Edges of all tetrahedra whose sphere holds no other point.
Edges by_brute_force(const Points& points) {
  const auto n = static_cast<Index>(points.cols());
  std::set<std::array<Index, 2>> edges;
  for (Index a = 0; a < n; ++a)
    for (Index b = a + 1; b < n; ++b)
      for (Index c = b + 1; c < n; ++c)
        for (Index d = c + 1; d < n; ++d) {
          const std::array corners = {a, b, c, d};
          Eigen::Matrix3d sides;
          Vec3 right;
          for (int i = 0; i < 3; ++i) {
            sides.row(i) = (points.col(corners[static_cast<std::size_t>(i) + 1]) - points.col(a)).transpose();
            right[i] = sides.row(i).squaredNorm() / 2;
          }
          const Vec3 center = sides.inverse() * right;  // from a
          bool is_empty = true;
          for (Index p = 0; p < n && is_empty; ++p)
            is_empty = std::find(corners.begin(), corners.end(), p) != corners.end() ||
                       (points.col(p) - points.col(a) - center).norm() > center.norm();
          if (!is_empty) continue;
          for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = i + 1; j < 4; ++j) edges.insert({corners[i], corners[j]});
        }
  return {edges.begin(), edges.end()};
}

}  // namespace

TEST(DelaunayEdges, are_those_of_tetrahedra_whose_spheres_are_empty) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Points points = scattered_points(25, seed);
    EXPECT_EQ(delaunay_edges(points), by_brute_force(points)) << seed;
  }
}

TEST(DelaunayEdges, of_a_tetrahedron_are_its_six_sides) {
  EXPECT_EQ(delaunay_edges(scattered_points(4, 3)), (Edges{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}));
}

TEST(DelaunayEdges, of_a_lattice_hold_every_side_of_its_cubes) {
  // All corners of a cube lie on one sphere, so which diagonals there are is open.
  Points lattice(3, 27);
  for (Index i = 0; i < 27; ++i) lattice.col(i) = Vec3(i % 3, i / 3 % 3, i / 9);
  const Edges edges = delaunay_edges(lattice);
  Index sides = 0;
  for (const auto& [a, b] : edges) {
    const Real length = (lattice.col(a) - lattice.col(b)).norm();
    EXPECT_LT(length, 1.8) << "across more than one cube";
    sides += length < 1.1;
  }
  EXPECT_EQ(sides, 54);
}

TEST(DelaunayEdges, do_not_depend_on_the_unit) {
  const Points points = scattered_points(60, 9);
  EXPECT_EQ(delaunay_edges(1e-3 * points), delaunay_edges(points));
}

TEST(DelaunayEdges, points_in_a_plane_or_too_few_are_an_error) {
  Points flat = scattered_points(10, 4);
  flat.row(2).setZero();
  EXPECT_THROW(delaunay_edges(flat), InputError);
  EXPECT_THROW(delaunay_edges(scattered_points(3, 4)), InputError);
  Points broken = scattered_points(10, 4);
  broken(1, 3) = std::numeric_limits<Real>::quiet_NaN();
  EXPECT_THROW(delaunay_edges(broken), InputError);
}

TEST(DelaunayEdges, of_points_that_coincide_one_alone_has_them) {
  Points points = scattered_points(12, 5);
  points.col(11) = points.col(2);
  Index own = 0, of_twin = 0;
  for (const auto& [a, b] : delaunay_edges(points)) {
    own += a == 2 || b == 2;
    of_twin += a == 11 || b == 11;
  }
  EXPECT_TRUE((own > 0) != (of_twin > 0));
}

}  // namespace gracilis
