#include <gracilis/methods/tissue/lattice.hpp>
#include <gracilis/methods/tissue/lattice_field.hpp>

#include <gracilis/anatomy/builtin/builtin_hip.hpp>
#include <gracilis/geometry/measures.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <map>

namespace gracilis::tissue {
namespace {

Vec3 place_at_rest(const Lattice& lattice, const EmbeddedPoint& point) { return mean_at(point, lattice.nodes); }

TEST(TissueLattice, a_cube_is_cut_into_five_tetrahedra_that_fill_it) {
  for (const int parity : {0, 1}) {
    const CubeCut& cut = cube_cut(parity);
    Real sum = 0;
    for (const Real share : cut.shares) {
      EXPECT_GT(share, 0);
      sum += share;
    }
    EXPECT_DOUBLE_EQ(sum, 1);
  }
}

TEST(TissueLattice, neighbors_cut_the_face_between_them_alike) {
  const Lattice lattice = build_lattice(shapes::box({0, 0, 0}, {0.05, 0.04, 0.06}), 0.01);
  // Faces of tetrahedra inside the lattice belong to two of them.
  std::map<std::array<Index, 3>, int> faces;
  for (const Cell& cell : lattice.cells)
    for (const auto& tetrahedron : cube_cut(cell.parity).tetrahedra)
      for (std::size_t left_out = 0; left_out < 4; ++left_out) {
        std::array<Index, 3> face{};
        for (std::size_t k = 0, n = 0; k < 4; ++k)
          if (k != left_out) face[n++] = cell.nodes[static_cast<std::size_t>(tetrahedron[k])];
        std::sort(face.begin(), face.end());
        ++faces[face];
      }
  Real open_area = 0;
  for (const auto& [face, count] : faces) {
    EXPECT_LE(count, 2);
    const Vec3 a = lattice.nodes.col(face[0]);
    if (count == 1)
      open_area += (Vec3(lattice.nodes.col(face[1])) - a).cross(Vec3(lattice.nodes.col(face[2])) - a).norm() / 2;
  }
  EXPECT_NEAR(open_area, 2 * (6 * 5 + 5 * 7 + 6 * 7) * 1e-4, 1e-9) << "only the lattice's outside is open";
}

TEST(TissueLattice, holds_every_vertex_of_the_built_in_hips_muscles_in_its_place) {
  for (const Muscle& muscle : builtin_hip().muscles) {
    const Lattice lattice = build_lattice(muscle.surface, 0.008);
    for (Index v = 0; v < muscle.surface.vertex_count(); ++v) {
      const EmbeddedPoint point = embed(lattice, muscle.surface.vertices.col(v));
      ASSERT_GE(point.cell, 0) << muscle.name << ", vertex " << v;
      EXPECT_GE(point.weights.minCoeff(), -1e-9);
      EXPECT_LT((place_at_rest(lattice, point) - muscle.surface.vertices.col(v)).norm(), 1e-12);
    }
  }
}

TEST(TissueLattice, the_filled_shares_sum_to_the_volume_of_the_surface) {
  const TriangleMesh ball = shapes::sphere(Vec3(0.1, 0.2, 0.3), 0.03, 4);
  const Lattice lattice = build_lattice(ball, 0.006);
  Real filled = 0;
  for (const Cell& cell : lattice.cells)
    for (std::size_t t = 0; t < 5; ++t)
      if (cell.fills[t] > least_fill) filled += cell.fills[t] * cube_cut(cell.parity).shares[t] * lattice.cell_volume();
  // 56 samples a tetrahedron, and the tetrahedra with less than a twentieth left out.
  EXPECT_NEAR(filled / enclosed_volume(ball.vertices, ball.faces), 1, 0.01);
}

TEST(TissueLattice, a_point_away_from_all_cells_is_in_none) {
  const Lattice lattice = build_lattice(shapes::sphere(Vec3::Zero(), 0.03, 3), 0.006);
  EXPECT_EQ(embed(lattice, Vec3(0.2, 0, 0)).cell, -1);
  EXPECT_EQ(embed(lattice, Vec3(0.0299, 0.0299, 0.0299)).cell, -1) << "in the box, outside of the cells";
}

TEST(TissueLattice, the_harmonic_field_of_a_bar_is_linear_and_its_gradient_runs_along) {
  const TriangleMesh bar = shapes::box({0, 0, 0}, {0.02, 0.02, 0.1});
  const Lattice lattice = build_lattice(bar, 0.005);
  std::vector<FieldGrip> grips;
  for (Real x = 0.001; x < 0.02; x += 0.002)
    for (Real y = 0.001; y < 0.02; y += 0.002) {
      grips.push_back({embed(lattice, Vec3(x, y, 0)), 1, -1});
      grips.push_back({embed(lattice, Vec3(x, y, 0.1)), 1, 0});
    }
  const Eigen::MatrixXd field = harmonic_lattice_fields(lattice, grips, 1);
  const Points gradients = cell_gradients(lattice, field.col(0));
  for (Index c = 0; c < lattice.cell_count(); ++c) {
    const Cell& cell = lattice.cells[static_cast<std::size_t>(c)];
    const Vec3 middle = lattice.nodes.col(cell.nodes[0]) + Vec3::Constant(lattice.cell_size / 2);
    if (middle.z() < 0.02 || middle.z() > 0.08 || cell.fill < 0.2) continue;
    // The grips are firm: they take less than a hundredth of the way.
    EXPECT_NEAR(gradients(2, c), 10, 0.1);
    EXPECT_LT(gradients.col(c).head<2>().norm(), 0.2);
  }
}

TEST(TissueLattice, a_field_that_is_fed_evenly_is_as_steep_at_the_ends_of_a_bar_as_in_its_middle) {
  const Lattice lattice = build_lattice(shapes::box({0, 0, 0}, {0.02, 0.02, 0.1}), 0.005);
  std::vector<FieldSource> sources;
  for (Real x = 0.0005; x < 0.02; x += 0.001)
    for (Real y = 0.0005; y < 0.02; y += 0.001) {
      sources.push_back({embed(lattice, Vec3(x, y, 0)), -1e-6});
      sources.push_back({embed(lattice, Vec3(x, y, 0.1)), 1e-6});
    }
  // 400 sources of 1e-6 m through 4 cm²: a slope of 1.
  const Points gradients = cell_gradients(lattice, fed_lattice_field(lattice, sources));
  for (Index c = 0; c < lattice.cell_count(); ++c)
    if (lattice.cells[static_cast<std::size_t>(c)].fill > 0.99) {
      EXPECT_NEAR(gradients(2, c), 1, 0.02);
      EXPECT_LT(gradients.col(c).head<2>().norm(), 0.02);
    }
}

}  // namespace
}  // namespace gracilis::tissue
