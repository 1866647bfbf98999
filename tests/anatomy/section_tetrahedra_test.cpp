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

/// Squares of 20 mm about a line along z, sections at these places.
SectionRings square_rod(const std::vector<Real>& places) {
  SectionRings rings{4, Points(3, static_cast<Index>(places.size())), Points(3, 4 * static_cast<Index>(places.size()))};
  for (std::size_t k = 0; k < places.size(); ++k) {
    const auto at = static_cast<Index>(k);
    rings.centers.col(at) = Vec3(0, 0, places[k]);
    for (Index i = 0; i < 4; ++i)
      rings.corner(at, i) = Vec3(i == 0 || i == 3 ? 0.01 : -0.01, i < 2 ? 0.01 : -0.01, places[k]);
  }
  return rings;
}

TEST(Tetrahedra, tendons_end_where_they_are_said_to_wherever_sections_lie) {
  const Real area = 4e-4;
  for (const auto& [origin, insertion] : {std::pair(0.03, 0.05), std::pair(0.01, 0.16), std::pair(0.0, 0.05),
                                          std::pair(0.05, 0.0), std::pair(0.06, 0.1), std::pair(0.1, 0.1)}) {
    const std::vector<Real> places = {0.1, 0.15, 0.16, 0.3};
    const Tetrahedra cells = tetrahedra_of(square_rod(places), places, origin, insertion);
    const Real tendon = std::min(origin + insertion, 0.2);
    EXPECT_NEAR(compartment_volume(cells, Compartment::tendon), tendon * area, 1e-15) << origin << ' ' << insertion;
    EXPECT_NEAR(compartment_volume(cells, Compartment::muscle), (0.2 - tendon) * area, 1e-15);
    for (Eigen::Index i = 0; i < cells.cells.cols(); ++i) EXPECT_GT(cell_volume(cells, i), 0);
    EXPECT_EQ(cells.compartments.size(), static_cast<std::size_t>(cells.cells.cols()));
  }
}

TEST(Tetrahedra, sections_that_are_put_in_lie_between_their_neighbors) {
  const std::vector<Real> places = {0, 0.1};
  const Tetrahedra cells = tetrahedra_of(square_rod(places), places, 0.03, 0.02);
  ASSERT_EQ(cells.points.cols(), 4 * 5);
  const Real heights[] = {0, 0.03, 0.08, 0.1};
  for (Index k = 0; k < 4; ++k) {
    for (Index i = 0; i < 4; ++i) EXPECT_NEAR(cells.points(2, 4 * k + i), heights[k], 1e-15);
    EXPECT_LT((cells.points.col(16 + k) - Vec3(0, 0, heights[k])).norm(), 1e-15);
  }
  EXPECT_EQ(cells.cells.cols(), 3 * 4 * 3);
}

TEST(Tetrahedra, a_dented_outline_is_not_convex_and_one_with_a_corner_in_a_side_is) {
  SectionRings rings{5, Points::Zero(3, 1), Points::Zero(3, 5)};
  rings.corners << 1, 1, 0, -1, -1, -1, 1, 1, 1, -1, 0, 0, 0, 0, 0;
  EXPECT_TRUE(section_shape(rings, 0).convex);
  EXPECT_NEAR(section_shape(rings, 0).area, 4, 1e-15);
  EXPECT_NEAR(section_shape(rings, 0).perimeter, 8, 1e-15);
  EXPECT_NEAR(section_shape(rings, 0).quotient, pi / 4, 1e-15);
  for (Index turn = 0; turn < 5; ++turn) {  // whichever corner comes first
    SectionRings dented = rings;
    dented.corners(1, 2) = 0.9;
    Points turned(3, 5);
    for (Index i = 0; i < 5; ++i) turned.col(i) = dented.corners.col((i + turn) % 5);
    dented.corners = turned;
    EXPECT_FALSE(section_shape(dented, 0).convex) << turn;
    dented.corners = turned.rowwise().reverse().eval();
    EXPECT_FALSE(section_shape(dented, 0).convex) << "the other way round, too";
  }
  SectionRings nothing{3, Points::Zero(3, 1), Points::Zero(3, 3)};
  EXPECT_EQ(section_shape(nothing, 0).quotient, 0);
}

TEST(Tetrahedra, in_a_ring_that_is_squeezed_the_center_goes_by_its_size) {
  const SectionRings rest = square_rod({0, 0.1});
  Points centers = rest.centers;
  centers.row(0).array() += 0.004;
  Points squeezed = rest.corners;
  squeezed.row(1) /= 2;
  squeezed.row(2).array() += 0.3;
  const SectionRings rings = rings_of(squeezed, 4, rest.corners, centers);
  // Root mean square distances from the middle: of 1 and 1/4 for 1 and 1.
  const Real size = std::sqrt(1.25 / 2);
  for (Index k = 0; k < 2; ++k)
    EXPECT_LT((rings.centers.col(k) - Vec3(size * 0.004, 0, 0.3 + 0.1 * k)).norm(), 1e-12) << k;
  EXPECT_EQ(rings.corners, squeezed);
  const Points nowhere = Points::Zero(3, 8);
  EXPECT_TRUE(rings_of(rest.corners, 4, nowhere, Points::Zero(3, 2)).centers.allFinite());
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
