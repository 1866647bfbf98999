#include "../shapes.hpp"

#include <gracilis/geometry/symmetry_plane.hpp>

#include <gtest/gtest.h>

namespace gracilis {
namespace {

/// A body with one plane of symmetry: a ball that is long in one direction, with a nose.
TriangleMesh nosed(const Vec3& along_plane, const Vec3& normal) {
  TriangleMesh mesh = shapes::sphere(Vec3::Zero(), 0.02, 4);
  const Vec3 up = along_plane.cross(normal);
  for (auto p : mesh.vertices.colwise()) {
    const Real ahead = p.dot(along_plane) / 0.02, above = p.dot(up) / 0.02;
    p += 0.01 * ahead * ahead * ahead * along_plane + 0.012 * above * std::abs(above) * (1 + 0.5 * ahead) * up;
  }
  return mesh;
}

}  // namespace

TEST(SymmetryPlane, is_found_from_a_guess_that_is_off_by_twenty_degrees) {
  const Vec3 normal = Vec3(1, 2, -1).normalized(), ahead = normal.unitOrthogonal();
  TriangleMesh mesh = nosed(ahead, normal);
  const Vec3 shift(0.3, -0.1, 0.2);
  mesh.vertices.colwise() += shift;
  const SymmetryPlane plane = symmetry_plane(mesh, Eigen::AngleAxisd(radians(20), ahead) * normal);
  EXPECT_GT(plane.normal.dot(normal), std::cos(radians(1))) << "triangles of 2 mm are no mirror images themselves";
  EXPECT_LT(std::abs((plane.point - shift).dot(normal)), 2e-4);
  EXPECT_LT(plane.misfit, 5e-4);
}

TEST(SymmetryPlane, the_misfit_tells_that_there_is_none) {
  TriangleMesh mesh = nosed(Vec3::UnitX(), Vec3::UnitZ());
  for (auto p : mesh.vertices.colwise())
    if (p.z() > 0) p.z() *= 1 + 1.5 * std::max<Real>(0, p.x() / 0.02);
  EXPECT_GT(symmetry_plane(mesh, Vec3::UnitZ()).misfit, 1e-3);
}

}  // namespace gracilis
