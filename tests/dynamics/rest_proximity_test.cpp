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

TEST(RestProximityConstraint, a_point_over_a_face_and_the_face_share_the_way_by_their_inverse_masses) {
  Points points(3, 4);
  points << 0, 0.03, 0, 0.01, 0, 0, 0.03, 0.01, 0, 0, 0, -1e-5;
  Eigen::Vector4d inverse_masses(2, 2, 2, 3);
  Particles particles = make_particles(points, inverse_masses);
  const RestProximity place{{3, -1}, {0, 1, 2}, 1, 2e-5f};
  EXPECT_EQ(project_rest_proximities({place}, particles), 1);
  // The gap is missed by 30 µm. Each corner takes a third of the push: 3 of 3 + 3 · 2/9 parts are the point's.
  const Real push = 3e-5 / (3 + 2.0 / 3);
  EXPECT_NEAR(particles.position(3).z(), -1e-5 + 3 * push, 1e-9);
  for (const Index corner : {0, 1, 2}) EXPECT_NEAR(particles.position(corner).z(), -2 * push / 3, 1e-9) << corner;
  EXPECT_NEAR(particles.position(3).x(), 0.01, 1e-9);
}

TEST(RestProximityConstraint,
     a_particle_with_a_small_share_beside_fixed_ones_goes_twice_the_way_that_is_missing_at_most) {
  Points points(3, 4);
  points << 0, 0.03, 0, 0.0003, 0, 0, 0.03, 0.0003, 0, 0, 0, -1e-5;
  Particles particles = make_particles(points, Eigen::Vector4d(0, 1, 0, 0));
  EXPECT_EQ(project_rest_proximities({{{3, -1}, {0, 1, 2}, 1, 2e-5f}}, particles), 1);
  EXPECT_NEAR(particles.position(1).z(), -2 * 3e-5, 1e-9) << "its share is a hundredth, 30 µm are missing";
}

TEST(RestProximityConstraint, edges_share_the_way_by_where_they_pass_each_other) {
  Points points(3, 4);
  points << 0, 0.04, 0.01, 0.01, 0, 0, -0.03, 0.01, 0, 0, -1e-5, -1e-5;
  Particles particles = make_particles(points, Eigen::Vector4d(2, 3, 4, 5));
  const RestProximity place{{0, 1}, {2, 3, -1}, 1, 2e-5f};
  const float s = 0.25f, t = 0.75f;
  // along × other points to +z, and so does the way from the target to the probe: 10 µm of 20 are kept.
  const float push = 1e-5f / (2 * (1 - s) * (1 - s) + 3 * s * s + 4 * (1 - t) * (1 - t) + 5 * t * t);
  EXPECT_EQ(project_rest_proximities({place}, particles), 1);
  EXPECT_NEAR(particles.position(0).z(), 2 * (1 - s) * push, 1e-9);
  EXPECT_NEAR(particles.position(1).z(), 3 * s * push, 1e-9);
  EXPECT_NEAR(particles.position(2).z(), -1e-5 - 4 * (1 - t) * push, 1e-9);
  EXPECT_NEAR(particles.position(3).z(), -1e-5 - 5 * t * push, 1e-9);
}

TEST(RestProximityConstraint, what_passes_beside_a_face_or_beyond_an_edge_is_let_be) {
  Points points(3, 5);
  points << 0, 0.03, 0, 0.02, 0.02, 0, 0, 0.03, 0.02, 0.05, 0, 0, 0, -1e-5, -1e-5;
  const Particles rest = make_particles(points, Eigen::VectorXd::Ones(5));
  Particles particles = rest;
  EXPECT_EQ(project_rest_proximities({{{3, -1}, {0, 1, 2}, 1, 2e-5f}, {{3, 4}, {0, 1, -1}, 1, 2e-5f}}, particles), 0);
  EXPECT_EQ(particles.xyzw, rest.xyzw);
}

TEST(RestProximityConstraint, edges_count_where_they_pass_each_other_between_their_ends_alone) {
  // One along x from 0 to 20 mm; another along y, 10 mm long, 10 µm too low.
  const auto count = [](Real x, Real begin) {
    Points points(3, 6);
    points << 0, 0.02, 0.01, x, x, x + 0.01, 0, 0, -0.03, begin, begin + 0.01, begin, 0, 0, 0, 1e-5, 1e-5, 0.01;
    Particles particles = make_particles(points, Eigen::VectorXd::Ones(6));
    const Index pushed = project_rest_proximities({{{0, 1}, {3, 4, -1}, -1, 2e-5f}}, particles);
    Eigen::Matrix3Xi faces(3, 2);
    faces << 0, 3, 1, 4, 2, 5;
    const std::vector<RestProximity> found = find_rest_proximities(points, faces, 1e-4, particles);
    const auto crossing = std::count_if(found.begin(), found.end(), [](const RestProximity& place) {
      return place.probe == std::array<Index, 2>{0, 1} && place.target == std::array<Index, 3>{3, 4, -1};
    });
    EXPECT_EQ(crossing, pushed) << x << ' ' << begin;
    return pushed;
  };
  for (const Real x : {0.001, 0.01, 0.019}) EXPECT_EQ(count(x, -0.005), 1) << x;
  for (const Real x : {-0.001, 0.021, 0.035}) EXPECT_EQ(count(x, -0.005), 0) << x;
  for (const Real begin : {-0.009, -0.001}) EXPECT_EQ(count(0.01, begin), 1) << begin;
  for (const Real begin : {-0.025, -0.011, 0.001}) EXPECT_EQ(count(0.01, begin), 0) << begin;
}

TEST(RestProximityConstraint, one_particle_that_can_move_is_enough_whichever_it_is) {
  const Stack stack(5e-5);
  const std::size_t all = find_rest_proximities(stack.points, stack.faces, 1e-4, stack.particles()).size();
  std::size_t sum = 0;
  for (Index p = 0; p < 6; ++p) {
    const std::vector<RestProximity> found = find_rest_proximities(
        stack.points, stack.faces, 1e-4, make_particles(stack.points, Eigen::VectorXd::Unit(6, p)));
    EXPECT_GT(found.size(), 0u) << p;
    EXPECT_LT(found.size(), all) << p;
    sum += found.size();
  }
  EXPECT_EQ(sum, 4 * all) << "each crossing has four ends";
}

TEST(RestProximityConstraint, the_gap_is_half_of_the_distance_at_rest_on_the_side_of_rest) {
  for (const Real height : {4e-5, -4e-5}) {
    Stack inside(0);
    inside.points.rightCols(3) = (inside.points.leftCols(3) * 0.5).colwise() + Vec3(0.0025, 0.002, height);
    std::vector<Real> sides;
    for (const RestProximity& place : find_rest_proximities(inside.points, inside.faces, 1e-4, inside.particles())) {
      if (place.probe[1] >= 0) continue;
      EXPECT_NEAR(place.gap, 2e-5, 1e-9);
      sides.push_back(place.side);
    }
    ASSERT_EQ(sides.size(), 3u);
    for (const Real side : sides) EXPECT_EQ(side, height > 0 ? 1 : -1);
  }
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
