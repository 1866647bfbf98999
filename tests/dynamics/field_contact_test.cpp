#include <gracilis/dynamics/contact/field/field_contact.hpp>
#include <gracilis/dynamics/contact/field/field_contact_near.hpp>

#include "around_a_ball.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace gracilis {

TEST(FieldContact, pushes_a_particle_straight_out_to_its_gap) {
  Scenario scenario = points_at({{0.025, 0.0125, 0.00625}, {0, 0, -0.0301}}, {1, 5}, 0.0005f);
  scenario.look();
  EXPECT_EQ(scenario.push_particles(), 2);
  EXPECT_NEAR(scenario.radius_of(0), radius + 0.0005, 3e-5);
  EXPECT_NEAR(scenario.radius_of(1), radius + 0.0005, 3e-5);
  const Vec3 direction = scenario.particles.position(0).cast<Real>().normalized();
  EXPECT_GT(direction.dot(Vec3(4, 2, 1).normalized()), 0.9999);
}

TEST(FieldContact, leaves_what_is_clear_of_the_gap_fixed_or_outside_of_the_field) {
  Scenario scenario = points_at({{0.031, 0, 0}, {0.01, 0, 0}, {0.2, 0, 0}, {-0.0306, 0, 0}}, {1, 0, 1, 1}, 0.0005f);
  const AlignedVector<float> before = scenario.particles.xyzw;
  scenario.look();
  EXPECT_EQ(scenario.push_particles(), 0);
  EXPECT_EQ(scenario.particles.xyzw, before);
}

TEST(FieldContact, an_overlap_at_rest_may_stay_but_not_grow) {
  Scenario scenario = points_at({{0.0291, 0, 0}, {0, 0.028, 0}}, {1, 1}, -0.001f);
  scenario.look();
  EXPECT_EQ(scenario.push_particles(), 1);
  EXPECT_EQ(scenario.particles.position(0).x(), 0.0291f);
  EXPECT_NEAR(scenario.radius_of(1), radius - 0.001, 1e-5);
}

TEST(FieldContact, acts_in_the_frame_of_the_moved_obstacle) {
  Scenario scenario = points_at({{0.5, 0.2, 0.029}}, {1}, 0.0005f);
  const Eigen::Matrix3f rotation(Eigen::AngleAxisf(1.1f, Eigen::Vector3f(1, 2, 3).normalized()));
  scenario.placement = {rotation, -rotation * Eigen::Vector3f(0.5f, 0.2f, 0), 0};
  scenario.look();
  EXPECT_EQ(scenario.push_particles(), 1);
  EXPECT_NEAR(scenario.radius_of(0), radius + 0.0005, 3e-5);
  EXPECT_NEAR((scenario.particles.position(0) - Eigen::Vector3f(0.5f, 0.2f, 0.0305f)).norm(), 0, 1e-4);
}

TEST(FieldContact, at_the_middle_of_the_ball_where_no_way_out_can_be_read_nothing_breaks) {
  Scenario scenario = points_at({{0, 0, 0}, {1e-6, 0, 0}}, {1, 1}, 0);
  scenario.look();
  scenario.push_particles();
  EXPECT_TRUE(std::isfinite(scenario.radius_of(0)));
  EXPECT_TRUE(std::isfinite(scenario.radius_of(1)));
}

TEST(FieldContact, lists_exactly_the_movable_particles_within_reach) {
  const TriangleMesh mesh = shapes::sphere({0.02, 0, 0}, 0.025, 4);
  SystemOptions options;
  options.fixed_share = 0.2;
  const SurfaceSystem system = system_of(mesh, options);
  FieldContactSet contact;
  contact.field = bounded(ball());
  set_gap(contact, static_cast<std::size_t>(mesh.vertex_count()), 0.001f);
  NearField near;
  Particles particles = system.rest;
  find_near(contact, system.distances, {}, {}, 0.004f, particles, near);
  std::vector<Index> expected;
  for (Index i = 0; i < mesh.vertex_count(); ++i)
    if (system.rest.inverse_mass(i) > 0 && sample(ball(), Eigen::Vector3f(system.rest.position(i))).distance < 0.005f)
      expected.push_back(i);
  EXPECT_GT(expected.size(), 200u);
  EXPECT_LT(expected.size(), static_cast<std::size_t>(mesh.vertex_count()) * 7 / 10);
  EXPECT_EQ(near.particles, expected);
}

}  // namespace gracilis
