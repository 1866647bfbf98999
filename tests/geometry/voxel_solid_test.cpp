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
