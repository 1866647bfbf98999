#include <gracilis/anatomy/sections/surface_slices.hpp>

#include <gracilis/anatomy/sections/cylinder_surface.hpp>
#include <gracilis/geometry/box_mesh.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace gracilis {
namespace {

using Outline = Eigen::Matrix2Xd;

/// Signed, and the centroid.
std::pair<Real, Eigen::Vector2d> area_of(const Outline& outline) {
  Real twice = 0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (Index i = 0; i < outline.cols(); ++i) {
    const Eigen::Vector2d a = outline.col(i), b = outline.col((i + 1) % outline.cols());
    const Real part = a.x() * b.y() - a.y() * b.x();
    twice += part, sum += part * (a + b) / 3;
  }
  return {twice / 2, sum / twice};
}

/// A prism along z over a right triangle with legs of 30 and 40 mm.
TriangleMesh prism(Real length) {
  return shapes::mesh_of({{0, 0, 0}, {0.03, 0, 0}, {0, 0.04, 0}, {0, 0, length}, {0.03, 0, length}, {0, 0.04, length}},
                         {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}});
}

TriangleMesh turned_and_moved(TriangleMesh mesh) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.3, Vec3(1, -2, 2).normalized()).toRotationMatrix();
  mesh.vertices = ((turn * mesh.vertices).colwise() + Vec3(0.3, -0.2, 0.5)).eval();
  return mesh;
}

}  // namespace

TEST(SurfaceSlices, lie_across_a_box_however_uneven_its_triangles_are_and_wherever_it_lies) {
  // A finely divided box upon a coarse one, one surface: the axis follows from the area alone.
  TriangleMesh box = box_mesh({0, 0, 0}, {0.02, 0.03, 0.2}, {3, 1, 9});
  for (Index v = 0; v < box.vertex_count(); ++v)
    box.vertices(2, v) = 0.2 * std::pow(box.vertices(2, v) / 0.2, 3),
                    box.vertices(0, v) = 0.02 * std::pow(box.vertices(0, v) / 0.02, 2);
  for (const TriangleMesh& mesh : {box, turned_and_moved(box)}) {
    const std::vector<SurfaceSlice> slices = surface_slices(mesh, 4);
    ASSERT_EQ(slices.size(), 4u);
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_NEAR(slices[k].place, 0.04 * static_cast<Real>(k + 1), 1e-12);
      EXPECT_EQ(slices[k].outlines, 1);
      EXPECT_NEAR(slices[k].shape.area, 6e-4, 1e-12);
      EXPECT_NEAR(slices[k].shape.perimeter, 0.1, 1e-12);
      EXPECT_TRUE(slices[k].shape.convex);
    }
  }
}

TEST(SurfaceSlices, outlines_run_counterclockwise_about_their_centroid) {
  for (const TriangleMesh& mesh : {prism(0.5), turned_and_moved(prism(0.5))})
    for (const SurfaceSlice& slice : surface_slices(mesh, 3)) {
      const auto [area, centroid] = area_of(slice.outline);
      EXPECT_LT(centroid.norm(), 1e-12);
      // A prism's own axis leans by its uneven sides: its slices are as much larger as they lie aslant.
      EXPECT_NEAR(area, 6e-4, 2e-5);
      EXPECT_NEAR(slice.shape.area, area, 1e-12);
      EXPECT_NEAR(slice.shape.quotient, 4 * pi * 6e-4 / (0.12 * 0.12), 0.02);
    }
}

TEST(SurfaceSlices, of_several_curves_the_one_with_the_largest_area_counts) {
  // Three rods side by side; the second is the thickest, and the third ends half way.
  const auto rod = [](Real x, Real width, Real length) { return shapes::box({x, 0, 0}, {x + width, 0.01, length}); };
  const TriangleMesh rods =
      shapes::both(shapes::both(rod(0, 0.005, 0.4), rod(0.006, 0.008, 0.4)), rod(0.015, 0.002, 0.19));
  const std::vector<SurfaceSlice> slices = surface_slices(rods, 3);
  EXPECT_EQ(slices[0].outlines, 3);
  EXPECT_EQ(slices[2].outlines, 2);
  for (const SurfaceSlice& slice : slices) EXPECT_NEAR(slice.shape.area, 8e-5, 2e-6);
}

TEST(SectionVertices, rings_go_around_the_line_and_faces_enclose_what_is_between_them) {
  Points line(3, 3);
  line << 0, 0, 0, 0, 0, 0, 0, 0.1, 0.3;
  Eigen::MatrixXd radii(4, 3);
  radii << 0.01, 0.02, 0.01, 0.01, 0.02, 0.01, 0.01, 0.02, 0.01, 0.01, 0.02, 0.01;
  const Points vertices = section_vertices(line, section_frames(line, Vec3::UnitX()), radii);
  ASSERT_EQ(vertices.cols(), 14);
  for (Index k = 0; k < 3; ++k)
    for (Index i = 0; i < 4; ++i) {
      const Vec3 out = vertices.col(4 * k + i) - line.col(k);
      EXPECT_LT((out - radii(i, k) * Vec3(std::cos(pi / 2 * i), std::sin(pi / 2 * i), 0)).norm(), 1e-15);
    }
  EXPECT_EQ(vertices.col(12), line.col(0));
  EXPECT_EQ(vertices.col(13), line.col(2));
  const Eigen::Matrix3Xi faces = section_faces(3, 4);
  ASSERT_EQ(faces.cols(), 2 * 4 * 2 + 8);
  Real six_volumes = 0;
  for (const Eigen::Vector3i face : faces.colwise())
    six_volumes += vertices.col(face[0]).dot(Vec3(vertices.col(face[1])).cross(Vec3(vertices.col(face[2]))));
  // Frusta over squares with diagonals of 20 and 40 mm, whose sides are flat.
  const Real small = 2e-4, large = 8e-4, frustum = (small + large + std::sqrt(small * large)) / 3;
  EXPECT_NEAR(six_volumes / 6, 0.3 * frustum, 1e-15);
}

}  // namespace gracilis
