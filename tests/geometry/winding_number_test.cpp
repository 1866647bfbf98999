#include <gracilis/geometry/winding_number.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <random>

namespace gracilis {
namespace {

/// Without any tree: the sum over all triangles.
Real exact(const TriangleMesh& mesh, const Vec3& p) {
  Real sum = 0;
  for (Index f = 0; f < mesh.face_count(); ++f)
    sum += solid_angle_share(p, mesh.vertices.col(mesh.faces(0, f)), mesh.vertices.col(mesh.faces(1, f)),
                             mesh.vertices.col(mesh.faces(2, f)));
  return sum;
}

std::vector<Vec3> random_places(int count, Real half_width) {
  std::mt19937 generator(6);
  std::uniform_real_distribution<Real> uniform(-half_width, half_width);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) points.emplace_back(uniform(generator), uniform(generator), uniform(generator));
  return points;
}

TriangleMesh without_faces(TriangleMesh mesh, Index count) {
  mesh.faces = mesh.faces.rightCols(mesh.face_count() - count).eval();
  return mesh;
}

}  // namespace

TEST(WindingNumber, is_one_inside_and_zero_outside_of_a_closed_surface) {
  const WindingNumber winding(shapes::sphere(Vec3::Zero(), 0.05, 4));
  int inside = 0;
  for (const Vec3& p : random_places(1000, 0.08)) {
    if (std::abs(p.norm() - 0.05) < 0.001) continue;
    EXPECT_NEAR(winding.query(p), p.norm() < 0.05 ? 1 : 0, 0.01);
    inside += p.norm() < 0.05;
  }
  EXPECT_GT(inside, 50);
}

TEST(WindingNumber, errs_by_less_than_a_hundredth_on_surfaces_with_holes) {
  const TriangleMesh mesh = without_faces(shapes::sphere(Vec3::Zero(), 0.05, 4), 300);
  const WindingNumber winding(mesh);
  Real between = 0;
  for (const Vec3& p : random_places(1000, 0.12)) {
    const Real expected = exact(mesh, p);
    EXPECT_NEAR(winding.query(p), expected, 0.01);
    between = std::max(between, std::min(expected, 1 - expected));
  }
  EXPECT_GT(between, 0.1) << "the hole was never seen";
}

TEST(WindingNumber, the_expansion_of_a_patch_errs_by_the_cube_of_its_size_over_its_distance) {
  // Of a bent patch of eight triangles, which are a leaf: from ten radii on its expansion answers.
  std::vector<Vec3> rim;
  std::vector<Eigen::Vector3i> faces;
  for (int i = 0; i < 8; ++i) {
    const Real angle = pi / 4 * i;
    rim.emplace_back(0.01 * std::cos(angle), 0.008 * std::sin(angle), 0.003 * std::cos(2 * angle) + 0.002 * (i % 3));
    faces.emplace_back(8, i, (i + 1) % 8);
  }
  rim.emplace_back(0.001, -0.002, 0.004);
  const TriangleMesh patch = shapes::mesh_of(rim, faces);
  const WindingNumber winding(patch);
  for (const Vec3& place : random_places(40, 1)) {
    const Vec3 direction = place.normalized();
    for (const Real distance : {0.1, 1.0}) {
      const Real found = winding.query(distance * direction), expected = exact(patch, distance * direction);
      const Real size = 0.011 / distance, seen = 3e-4 / (4 * pi * distance * distance);
      EXPECT_NEAR(found, expected, 10 * size * size * size * seen) << distance << ' ' << direction.transpose();
    }
  }
}

TEST(WindingNumber, of_a_surface_turned_inside_out_is_negative) {
  TriangleMesh mesh = shapes::box(Vec3::Constant(-1), Vec3::Constant(1));
  mesh.faces.row(0).swap(mesh.faces.row(1));
  EXPECT_NEAR(WindingNumber(mesh).query(Vec3(0.1, 0.2, 0.3)), -1, 0.01);
}

TEST(SolidAngle, of_an_octant_is_an_eighth) {
  EXPECT_NEAR(std::abs(solid_angle_share(Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ())), 0.125, 1e-14);
  EXPECT_NEAR(solid_angle_share(Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()),
              -solid_angle_share(Vec3::Zero(), Vec3::UnitY(), Vec3::UnitX(), Vec3::UnitZ()), 1e-14);
}

TEST(SolidAngle, of_a_degenerate_triangle_or_from_its_corner_is_finite) {
  EXPECT_NEAR(solid_angle_share(Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitX(), Vec3::UnitY()), 0, 1e-14);
  EXPECT_TRUE(std::isfinite(solid_angle_share(Vec3::UnitX(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ())));
}

}  // namespace gracilis
