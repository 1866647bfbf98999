#include <gracilis/anatomy/sections/cylinder_surface.hpp>
#include <gracilis/anatomy/sections/spindle.hpp>
#include <gracilis/anatomy/sections/tendon_lengths.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/mesh_inspection.hpp>
#include <gracilis/geometry/polylines.hpp>
#include <gracilis/scene/section_line.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace gracilis {

/// A line with this many points between its ends.
static Points line_with(int via_points) {
  Points line(3, via_points + 2);
  for (int i = 0; i < line.cols(); ++i) line.col(i) = Vec3(0.01 * i, 0.02 * (i % 2), 0.3 * i);
  return line;
}

/// Vertices of the thesis' 48 muscles of the lower limb, which have 48 via points: here one each.
static Eigen::Index vertices_of_48_muscles(int scaling, int rays) {
  Eigen::Index count = 0;
  for (int muscle = 0; muscle < 48; ++muscle) {
    const int via_points = muscle < 3 ? 3 : muscle < 30 ? 1 : muscle < 36 ? 2 : 0;
    const Points line = subdivide_line(line_with(via_points), scaling);
    const SectionFrames frames = section_frames(line, Vec3::UnitX());
    count += section_vertices(line, frames, Eigen::MatrixXd::Constant(rays, line.cols(), 0.01)).cols();
  }
  return count;
}

TEST(CylinderGeometry, forty_eight_muscles_have_the_published_numbers_of_vertices) {
  const int published[3][4] = {{960, 1248, 1536, 1824}, {1536, 2016, 2496, 2976}, {2688, 3552, 4416, 5280}};
  for (int scaling = 0; scaling < 3; ++scaling)
    for (int column = 0; column < 4; ++column)
      EXPECT_EQ(vertices_of_48_muscles(scaling, 6 + 2 * column), published[scaling][column]) << scaling << column;
  EXPECT_EQ(vertices_of_48_muscles(1, 36), 8736);
}

TEST(CylinderGeometry, tibialis_anterior_has_the_published_lengths) {
  const TendonLengths lengths = tendon_lengths(0.098, 0.087, 0.223, 0.303, 0.292);
  EXPECT_NEAR(lengths.rest, 0.3206, 1e-4);
  EXPECT_NEAR(lengths.scaled_rest, 0.309, 5e-4);
  EXPECT_NEAR(lengths.scaled_tendon, 0.215, 5e-4);
  EXPECT_NEAR(lengths.scaled_tendon / 2, 0.107, 1e-3);
}

TEST(CylinderGeometry, a_section_stands_where_a_tendon_ends_walked_along_the_line) {
  ActionLine line;
  line.points.resize(3, 4);
  line.points << 0, 1, 1, 1, 0, 0, 1, 1.5, 0, 0, 0, 0;
  line.tendon = 0.75;  // longer than the last part, which eqs. 3.12 and 3.13 would test by itself
  EXPECT_EQ(section_line(line).centers.cols(), 4);
  line.tendon_sections = true;
  SectionLine sections = section_line(line);
  ASSERT_EQ(sections.centers.cols(), 5);
  EXPECT_EQ(sections.tendon_ends, std::vector<Index>{2});
  EXPECT_TRUE(sections.centers.col(2).isApprox(Vec3(1, 0.75, 0)));
  line.origin_tendon = 0.5;
  sections = section_line(line);
  EXPECT_EQ(sections.tendon_ends, (std::vector<Index>{1, 3}));
  EXPECT_TRUE(sections.centers.col(1).isApprox(Vec3(0.5, 0, 0)));
  line.tendon = 2;  // beyond the end of the other
  line.origin_tendon = 1.2;
  sections = section_line(line);
  EXPECT_EQ(sections.tendon_ends, (std::vector<Index>{1, 3}));
  EXPECT_TRUE(sections.centers.col(1).isApprox(Vec3(0.5, 0, 0)));
  EXPECT_TRUE(sections.centers.col(3).isApprox(Vec3(1, 0.2, 0)));
  line.tendon = 1.5;  // at a point that is there already
  line.origin_tendon = 0;
  EXPECT_EQ(section_line(line).centers.cols(), 4);
  line.tendon = 9;
  EXPECT_EQ(section_line(line).centers.cols(), 4);
}

TEST(CylinderGeometry, subdividing_keeps_the_given_points) {
  const Points line = line_with(2), fine = subdivide_line(line, 3);
  ASSERT_EQ(fine.cols(), 8 * 3 + 1);
  for (Eigen::Index i = 0; i < line.cols(); ++i) EXPECT_EQ(fine.col(8 * i), line.col(i));
  EXPECT_NEAR(polyline_length(fine), polyline_length(line), 1e-14);
}

TEST(CylinderGeometry, the_surface_is_closed_and_turned_outwards) {
  const Points line = subdivide_line(line_with(2), 1);
  const SectionFrames frames = section_frames(line, Vec3::UnitY());
  const Eigen::MatrixXd radii = Eigen::MatrixXd::Constant(8, line.cols(), 0.01);
  const TriangleMesh mesh{section_vertices(line, frames, radii), section_faces(static_cast<Index>(line.cols()), 8)};
  const MeshReport report = inspect_mesh(mesh);
  EXPECT_TRUE(report.is_closed() && report.is_manifold() && report.is_oriented());
  EXPECT_EQ(report.genus, 0);
  EXPECT_GT(report.volume, 0);
}

TEST(CylinderGeometry, sections_stand_across_the_difference_of_their_neighbors) {
  Points line(3, 3);
  line << 0, 1, 1, 0, 0, 1, 0, 0, 0;
  const SectionFrames frames = section_frames(line, Vec3::UnitZ());
  EXPECT_TRUE(frames.normals.col(0).isApprox(Vec3::UnitX()));
  EXPECT_TRUE(frames.normals.col(1).isApprox(Vec3(1, 1, 0).normalized()));
  EXPECT_TRUE(frames.normals.col(2).isApprox(Vec3::UnitY()));
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(frames.first_rays.col(k).isApprox(Vec3::UnitZ()));  // no twist
}

TEST(CylinderGeometry, a_spindle_has_the_muscles_volume_and_ends_in_its_tendon) {
  MuscleSize size;
  size.max_isometric_force = 1000;
  size.optimal_fiber = 0.1;
  size.pennation = 0.2;
  const Real wanted = 1000 / 6.1e5 * 0.1 / std::cos(0.2);
  EXPECT_NEAR(muscle_volume(size), wanted, 1e-15);
  const Eigen::VectorXd positions = Eigen::VectorXd::LinSpaced(61, 0, 0.3);
  const Eigen::VectorXd radii = spindle_radii(size, positions, 0.1);
  Real volume = 0;
  for (int i = 1; i <= 40; ++i)
    volume += pi / 3 * 0.005 * (radii[i] * radii[i] + radii[i] * radii[i - 1] + radii[i - 1] * radii[i - 1]);
  EXPECT_NEAR(volume, wanted, 1e-9);
  EXPECT_NEAR(radii[60], std::sqrt(1000 / 3.2e7 / pi), 1e-12);
  EXPECT_NEAR(radii[45], radii[60], 1e-12);
  EXPECT_NEAR(radii[0], radii[60], 1e-12);
}

}  // namespace gracilis
