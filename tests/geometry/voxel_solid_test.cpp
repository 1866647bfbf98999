#include <gracilis/geometry/point_triangle.hpp>
#include <gracilis/geometry/signed_distance.hpp>
#include <gracilis/geometry/voxel_solid.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace gracilis {
namespace {

const TriangleMesh round_bone = shapes::sphere(Vec3::Zero(), 0.05, 3);

TEST(VoxelSolid, holds_what_the_surface_encloses_and_a_box_more_at_most) {
  const VoxelSolid solid(round_bone, 20);
  const SignedDistance exact(round_bone);
  std::mt19937 generator(3);
  std::uniform_real_distribution<Real> uniform(-0.06, 0.06);
  int inside = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 p(uniform(generator), uniform(generator), uniform(generator));
    const Real distance = exact.query(p).distance;
    const bool holds = solid.contains(p);
    EXPECT_TRUE(holds || distance >= 0);
    EXPECT_TRUE(!holds || distance <= solid.box_size().norm());
    inside += holds;
  }
  EXPECT_GT(inside, 1000);
}

TEST(VoxelSolid, a_box_whose_sides_lie_in_those_of_the_boxes_is_full_and_nothing_else) {
  const VoxelSolid solid(shapes::box({-0.1, -0.2, 0}, {0.1, 0.2, 0.01}), 8);
  EXPECT_TRUE(solid.contains({0, 0, 0.005}));
  EXPECT_TRUE(solid.contains({-0.1, -0.2, 0}));
  EXPECT_TRUE(solid.contains({0.1, 0.2, 0.01}));
  EXPECT_FALSE(solid.contains({0, 0, 0.0101}));
  EXPECT_FALSE(solid.contains({0, 0, -0.0001}));
}

TEST(VoxelSolid, a_cavity_is_full_and_what_a_bay_opens_to_is_empty) {
  // Two plates and a floor between them: a bay that is open above.
  const TriangleMesh bay = shapes::both(shapes::both(shapes::box({-0.05, -0.05, 0}, {-0.04, 0.05, 0.1}),
                                                     shapes::box({0.04, -0.05, 0}, {0.05, 0.05, 0.1})),
                                        shapes::box({-0.05, -0.05, 0}, {0.05, 0.05, 0.01}));
  EXPECT_FALSE(VoxelSolid(bay, 40).contains({0, 0, 0.05}));
  EXPECT_TRUE(VoxelSolid(round_bone, 40).contains({0, 0, 0})) << "no triangle comes near its middle";
}

TEST(VoxelSolid, the_way_out_is_the_shortest_one) {
  const VoxelSolid solid(shapes::box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}), 10);
  const Vec3 out = solid.nearest_empty({0.02, 0.03, 0.07});
  EXPECT_FALSE(solid.contains(out));
  EXPECT_LT((out - Vec3(0.02, 0.03, 0.1)).norm(), 1e-7);
  const Vec3 deep = solid.nearest_empty({0.001, 0, 0});
  EXPECT_LT((deep - Vec3(0.1, 0, 0)).norm(), 1e-7);
  const Vec3 outside(0.2, 0, 0);
  EXPECT_EQ(solid.nearest_empty(outside), outside);
}

TEST(VoxelSolid, the_way_back_ends_in_the_first_box_that_is_empty) {
  const VoxelSolid solid(shapes::box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}), 10);
  const Vec3 from(0.02, 0, 0.07), to(0.02, 0, 0.2), place = solid.first_empty(from, to);
  EXPECT_FALSE(solid.contains(place));
  EXPECT_NEAR(place.x(), 0.02, 1e-12);
  EXPECT_LT(place.z(), 0.1 + 0.02 + 1e-9);
  const Vec3 within(0.05, 0, 0);
  EXPECT_EQ(solid.first_empty(from, within), within) << "nothing on the way is empty";
  EXPECT_EQ(solid.first_empty(to, from), to);
}

/// A bowl of three boxes around an empty middle, and a rod beside it.
TriangleMesh rugged() {
  return shapes::both(
      shapes::both(shapes::box({0, 0, 0}, {0.1, 0.08, 0.02}), shapes::box({0, 0, 0.02}, {0.02, 0.08, 0.07})),
      shapes::both(shapes::box({0.07, 0, 0.02}, {0.1, 0.08, 0.05}),
                   shapes::box({0.03, 0.03, 0.04}, {0.04, 0.05, 0.06})));
}

TEST(VoxelSolid, no_empty_place_is_nearer_than_the_one_that_is_found) {
  const VoxelSolid solid(rugged(), 12);
  const Vec3 size = solid.box_size();
  EXPECT_LT((size - Vec3(0.1, 0.08, 0.07) / 12).norm(), 1e-12);
  std::mt19937 generator(4);
  std::uniform_real_distribution<Real> uniform(0, 1);
  int inside = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3 p(0.1 * uniform(generator), 0.08 * uniform(generator), 0.07 * uniform(generator));
    const Vec3 found = solid.nearest_empty(p);
    EXPECT_FALSE(solid.contains(found));
    if (!solid.contains(p)) {
      EXPECT_EQ(found, p);
      continue;
    }
    ++inside;
    // All boxes, and one layer around them.
    Real least = 1;
    for (int x = -1; x <= 12; ++x)
      for (int y = -1; y <= 12; ++y)
        for (int z = -1; z <= 12; ++z) {
          const Vec3 low = size.cwiseProduct(Vec3(x, y, z)), high = low + size;
          if (solid.contains((low + high) / 2)) continue;
          least = std::min(least, (p.cwiseMax(low).cwiseMin(high) - p).norm());
        }
    EXPECT_NEAR((found - p).norm(), least, 3e-6 * size.norm());
  }
  EXPECT_GT(inside, 100);
}

TEST(VoxelSolid, of_a_sheet_fills_the_boxes_that_it_touches_and_no_others) {
  const std::vector<Vec3> corners = {{0.01, 0.02, 0.0}, {0.1, 0.05, 0.03}, {0.03, 0.09, 0.1}};
  TriangleMesh sheet = shapes::mesh_of(corners, {{0, 1, 2}});
  const int boxes = 16;
  const VoxelSolid solid(sheet, boxes);
  const Vec3 low = sheet.vertices.rowwise().minCoeff(), size = solid.box_size();
  for (int i = 0; i <= 100; ++i)
    for (int j = 0; i + j <= 100; ++j) {
      const Vec3 p = corners[0] + (corners[1] - corners[0]) * i / 100 + (corners[2] - corners[0]) * j / 100;
      EXPECT_TRUE(solid.contains(p.cwiseMax(low).cwiseMin(sheet.vertices.rowwise().maxCoeff()))) << i << ' ' << j;
    }
  int full = 0;
  for (int x = 0; x < boxes; ++x)
    for (int y = 0; y < boxes; ++y)
      for (int z = 0; z < boxes; ++z) {
        const Vec3 begin = low + size.cwiseProduct(Vec3(x, y, z)), end = begin + size;
        if (!solid.contains((begin + end) / 2)) continue;
        ++full;
        // From the middle on to and fro between the nearest points of the two.
        Vec3 p = (begin + end) / 2, q;
        for (int round = 0; round < 400; ++round) {
          const Vec3 weights = nearest_barycentric(p, corners[0], corners[1], corners[2]);
          q = weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
          p = q.cwiseMax(begin).cwiseMin(end);
        }
        EXPECT_LT((p - q).norm(), 0.01 * size.norm()) << x << ' ' << y << ' ' << z;
      }
  EXPECT_GT(full, 100);
  EXPECT_LT(full, 1000);
}

TEST(VoxelSolid, the_way_back_takes_steps_of_a_box_at_most) {
  const VoxelSolid solid(shapes::box({0, 0, 0}, {0.1, 0.2, 0.4}), 10);
  const Vec3 from(0.05, 0.1, 0.2), to(0.05, 0.1, 0.6);
  // Ten steps of 0.04 m; the fifth comes to the side itself, the sixth is out.
  const Vec3 place = solid.first_empty(from, to);
  EXPECT_FALSE(solid.contains(place));
  EXPECT_GE(place.z(), 0.4);
  EXPECT_LE(place.z(), 0.44 + 1e-12);
  EXPECT_EQ(solid.first_empty(from, from), from);
}

TEST(VoxelSolid, what_is_not_finite_or_flat_is_no_trouble) {
  const VoxelSolid solid(round_bone, 5);
  EXPECT_FALSE(solid.contains(Vec3::Constant(std::numeric_limits<Real>::quiet_NaN())));
  TriangleMesh flat;
  flat.vertices.resize(3, 3);
  flat.vertices << 0, 1, 0, 0, 0, 1, 0, 0, 0;
  flat.faces.resize(3, 1);
  flat.faces << 0, 1, 2;
  EXPECT_TRUE(VoxelSolid(flat, 4).contains({0.2, 0.2, 0}));
  EXPECT_FALSE(VoxelSolid(flat, 4).contains({0.2, 0.2, 0.1}));
}

}  // namespace
}  // namespace gracilis
