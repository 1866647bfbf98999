#include <gracilis/anatomy/sections/cylinder_surface.hpp>
#include <gracilis/anatomy/sections/tetrahedra.hpp>
#include <gracilis/geometry/mesh_inspection.hpp>
#include <gracilis/geometry/polylines.hpp>
#include <gracilis/geometry/section_frames.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace gracilis {

/// A bent muscle of hexagons, thicker in its middle.
struct BentMuscle {
  Points line = Points(3, 3);
  SectionRings rings;
  TriangleMesh surface;
  std::vector<Real> places;

  BentMuscle() {
    line << 0, 0.01, 0, 0, 0, 0.01, 0, 0.05, 0.1;
    const Points fine = subdivide_line(line, 2);
    Eigen::MatrixXd radii(6, 9);
    for (int k = 0; k < 9; ++k)
      for (int i = 0; i < 6; ++i) radii(i, k) = 0.005 + 0.001 * (i % 2) + 0.006 * std::sin(pi * k / 8.0);
    surface = {section_vertices(fine, section_frames(fine, Vec3::UnitX()), radii), section_faces(9, 6)};
    rings = {6, fine, surface.vertices.leftCols(54)};
    places = distances_along(fine);
  }
};

TEST(Tetrahedra, fill_the_surface_without_overlap) {
  const BentMuscle muscle;
  const Tetrahedra cells = tetrahedra_of(muscle.rings, muscle.places, 0, 0);
  EXPECT_EQ(cells.cells.cols(), 3 * 6 * 8);  // three for each frustum
  Real volume = 0;
  for (Eigen::Index i = 0; i < cells.cells.cols(); ++i) {
    EXPECT_GT(cell_volume(cells, i), 0) << i;
    volume += cell_volume(cells, i);
  }
  EXPECT_NEAR(volume, inspect_mesh(muscle.surface).volume, 1e-15);
  EXPECT_EQ(compartment_volume(cells, Compartment::tendon), 0);
}

TEST(Tetrahedra, a_tendons_end_between_sections_divides_them) {
  const BentMuscle muscle;
  const Tetrahedra cells = tetrahedra_of(muscle.rings, muscle.places, 0.003, 0.02);
  EXPECT_EQ(cells.cells.cols(), 3 * 6 * 10);
  const Real belly = compartment_volume(cells, Compartment::muscle),
             tendon = compartment_volume(cells, Compartment::tendon);
  EXPECT_GT(belly, 0);
  EXPECT_GT(tendon, 0);
  EXPECT_NEAR(belly + tendon, inspect_mesh(muscle.surface).volume, 2e-8);  // interpolated sections lie a little inside
}

TEST(Tetrahedra, a_straight_hexagonal_rod_has_its_volumes_by_hand) {
  Points line(3, 2);
  line << 0, 0, 0, 0, 0, 0.3;
  const Points fine = subdivide_line(line, 2);
  const Points vertices =
      section_vertices(fine, section_frames(fine, Vec3::UnitX()), Eigen::MatrixXd::Constant(6, 5, 0.01));
  const SectionRings rings{6, fine, vertices.leftCols(30)};
  const Tetrahedra cells = tetrahedra_of(rings, distances_along(fine), 0, 0.1);
  const Real area = 1.5 * std::sqrt(3.0) * 1e-4;
  EXPECT_NEAR(compartment_volume(cells, Compartment::muscle), 0.2 * area, 1e-15);
  EXPECT_NEAR(compartment_volume(cells, Compartment::tendon), 0.1 * area, 1e-15);
  const SectionShape shape = section_shape(rings, 2);
  EXPECT_NEAR(shape.area, area, 1e-15);
  EXPECT_NEAR(shape.perimeter, 0.06, 1e-15);
  EXPECT_NEAR(shape.quotient, pi * std::sqrt(3.0) / 6, 1e-12);
  EXPECT_TRUE(shape.convex);
  EXPECT_NEAR(physiological_area(2e-4, pi / 3, 0.1), 1e-3, 1e-15);
}

TEST(Tetrahedra, a_star_is_not_convex) {
  Points line(3, 2);
  line << 0, 0, 0, 0, 0, 0.1;
  Eigen::MatrixXd radii(12, 2);
  for (int i = 0; i < 12; ++i) radii.row(i).setConstant(i % 2 == 0 ? 0.01 : 0.004);
  const Points vertices = section_vertices(line, section_frames(line, Vec3::UnitX()), radii);
  const SectionShape shape = section_shape({12, line, vertices.leftCols(24)}, 0);
  EXPECT_FALSE(shape.convex);
  EXPECT_LT(shape.quotient, 0.5);
}

TEST(Tetrahedra, centers_go_with_their_rings) {
  const BentMuscle muscle;
  Points centers = muscle.rings.centers;
  centers.row(0).array() += 0.001;  // beside the line
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.2, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const Points moved = (1.3 * turn * muscle.surface.vertices).colwise() + Vec3(0.1, 0.2, 0.3);
  const SectionRings rings = rings_of(moved, 6, muscle.surface.vertices, centers);
  EXPECT_LT((rings.centers - ((1.3 * turn * centers).colwise() + Vec3(0.1, 0.2, 0.3))).norm(), 1e-12);
}

}  // namespace gracilis
