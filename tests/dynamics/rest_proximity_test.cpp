#include <gracilis/dynamics/constraints/rest_proximity.hpp>

#include <gtest/gtest.h>

#include <algorithm>

namespace gracilis {

/// Two triangles `gap` above each other, the upper one turned by half a turn, with nothing in common.
struct Stack {
  Points points{3, 6};
  Eigen::Matrix3Xi faces{3, 2};

  explicit Stack(Real gap) {
    faces << 0, 3, 1, 5, 2, 4;
    points.leftCols(3) << 0, 0.01, 0.005, 0, 0, 0.01, 0, 0, 0;
    points.rightCols(3) << 0, 0.01, 0.005, 0.008, 0.008, -0.002, gap, gap, gap;
  }
  Particles particles() const { return make_particles(points, Eigen::VectorXd::Ones(6)); }
};

static std::size_t points_over_faces(const std::vector<RestProximity>& places) {
  return static_cast<std::size_t>(
      std::count_if(places.begin(), places.end(), [](const RestProximity& place) { return place.probe[1] < 0; }));
}

TEST(RestProximityConstraint, are_found_where_edges_cross_and_points_lie_over_faces_within_reach) {
  const Stack stack(5e-5);
  const std::vector<RestProximity> places = find_rest_proximities(stack.points, stack.faces, 1e-4, stack.particles());
  EXPECT_EQ(points_over_faces(places), 0u);
  EXPECT_EQ(places.size(), 6u);  // a star of two triangles has six crossings
  EXPECT_TRUE(find_rest_proximities(stack.points, stack.faces, 1e-5, stack.particles()).empty());

  Stack inside(5e-5);
  inside.points.rightCols(3) = (inside.points.leftCols(3) * 0.5).colwise() + Vec3(0.0025, 0.002, 5e-5);
  EXPECT_EQ(points_over_faces(find_rest_proximities(inside.points, inside.faces, 1e-4, inside.particles())), 3u);
}

TEST(RestProximityConstraint, a_flat_mesh_has_none_and_neighbors_at_an_edge_are_none) {
  Points points(3, 4);
  points << 0, 1, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0;
  Eigen::Matrix3Xi faces(3, 2);
  faces << 0, 0, 1, 2, 2, 3;
  EXPECT_TRUE(find_rest_proximities(points, faces, 1, make_particles(points, Eigen::VectorXd::Ones(4))).empty());
}

TEST(RestProximityConstraint, what_went_through_comes_back_to_its_side_and_the_center_of_mass_stays) {
  const Stack stack(5e-5);
  const Particles rest = stack.particles();
  const std::vector<RestProximity> places = find_rest_proximities(stack.points, stack.faces, 1e-4, rest);
  Particles particles = rest;
  for (const Index p : {3, 4, 5}) particles.position(p).z() = -3e-5f;
  EXPECT_GT(project_rest_proximities(places, particles), 0);
  for (int round = 0; round < 50; ++round) project_rest_proximities(places, particles);
  float lower = 0, upper = 0;
  for (const Index p : {0, 1, 2}) lower += particles.position(p).z();
  for (const Index p : {3, 4, 5}) upper += particles.position(p).z();
  EXPECT_GE((upper - lower) / 3, 2.4999e-5) << "half of the distance at rest";
  EXPECT_LE((upper - lower) / 3, 5e-5) << "and no more than it was";
  EXPECT_NEAR(upper + lower, 3 * -3e-5, 1e-8);
  EXPECT_EQ(project_rest_proximities(places, particles), 0);
}

TEST(RestProximityConstraint, touching_parts_keep_the_side_that_only_double_precision_can_tell) {
  for (const Real gap : {1e-12, -1e-12}) {
    const Stack stack(gap);
    Particles particles = stack.particles();
    const std::vector<RestProximity> places = find_rest_proximities(stack.points, stack.faces, 1e-4, particles);
    ASSERT_FALSE(places.empty());
    for (int round = 0; round < 50; ++round) project_rest_proximities(places, particles);
    EXPECT_GT((particles.position(3).z() - particles.position(0).z()) * (gap > 0 ? 1 : -1), 1e-6);
  }
}

TEST(RestProximityConstraint, what_is_far_on_the_wrong_side_is_left_to_contact) {
  const Stack stack(5e-5);
  const std::vector<RestProximity> places = find_rest_proximities(stack.points, stack.faces, 1e-4, stack.particles());
  Particles particles = stack.particles();
  for (const Index p : {3, 4, 5}) particles.position(p).z() = -0.005f;
  EXPECT_EQ(project_rest_proximities(places, particles), 0);
}

TEST(RestProximityConstraint, fixed_particles_and_triangles_without_area_are_left_out) {
  Stack stack(5e-5);
  EXPECT_TRUE(
      find_rest_proximities(stack.points, stack.faces, 1e-4, make_particles(stack.points, Eigen::VectorXd::Zero(6)))
          .empty());
  stack.points.rightCols(3).colwise() = stack.points.col(4).eval();
  EXPECT_TRUE(find_rest_proximities(stack.points, stack.faces, 1e-4, stack.particles()).empty());
}

}  // namespace gracilis
