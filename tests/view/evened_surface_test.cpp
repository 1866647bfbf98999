#include <gracilis/view/pictures/evened_surface.hpp>

#include <gracilis/geometry/measures.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace gracilis {

/// How far a rim's vertices lie up and down beside the means of their neighbors along it, m.
static Real notches(const Points& vertices, const std::vector<Index>& rim) {
  Real sum = 0;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const Index before = rim[(i + rim.size() - 1) % rim.size()], after = rim[(i + 1) % rim.size()];
    sum += std::abs(vertices(2, rim[i]) - (vertices(2, before) + vertices(2, after)) / 2);
  }
  return sum / static_cast<Real>(rim.size());
}

TEST(EvenedSurface, leaves_a_rim_without_notches_and_the_muscle_as_large) {
  // A flat muscle, 5 mm from vertex to vertex, whose upper rim goes up and down by 1 mm.
  TriangleMesh mesh = shapes::cylinder(0.02, 0.1, 24, 20);
  const Real top = mesh.vertices.row(2).maxCoeff();
  std::vector<Index> rim;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.vertices(2, v) > top - 1e-6 && mesh.vertices.col(v).head<2>().norm() > 0.019) rim.push_back(v);
  ASSERT_EQ(rim.size(), 24u);
  for (std::size_t i = 0; i < rim.size(); ++i) mesh.vertices(2, rim[i]) += i % 2 == 0 ? 0.001 : -0.001;
  const Points evened = EvenedSurface(mesh).of(mesh.vertices);
  EXPECT_GT(notches(mesh.vertices, rim), 0.0019);
  EXPECT_LT(notches(evened, rim), 0.0002);
  const Real before = enclosed_volume(mesh.vertices, mesh.faces), after = enclosed_volume(evened, mesh.faces);
  EXPECT_NEAR(after / before, 1, 0.03);
}

TEST(EvenedSurface, leaves_what_is_torn_out_of_it) {
  const TriangleMesh mesh = shapes::cylinder(0.02, 0.1, 24, 20);
  Points torn = mesh.vertices;
  const Index spike = 24 * 10;
  torn.col(spike) += 0.03 * Vec3(torn(0, spike), torn(1, spike), 0).normalized();
  const Points evened = EvenedSurface(mesh).of(torn);
  EXPECT_GT(evened.col(spike).head<2>().norm(), 0.045);
}

TEST(EvenedSurface, is_the_same_far_from_the_origin) {
  const TriangleMesh mesh = shapes::cylinder(0.02, 0.1, 24, 20);
  const Vec3 far(1e5, -2e5, 3e5);
  const Points there = EvenedSurface(mesh).of(mesh.vertices.colwise() + far);
  EXPECT_LT(((there.colwise() - far) - EvenedSurface(mesh).of(mesh.vertices)).cwiseAbs().maxCoeff(), 1e-7) << "single precision of 0.1 m";
}

}  // namespace gracilis
