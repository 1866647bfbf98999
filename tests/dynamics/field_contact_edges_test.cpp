#include <gracilis/dynamics/contact/field/field_contact.hpp>

#include "around_a_ball.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace gracilis {
namespace {

/// An edge whose ends are outside of the ball and whose middle is 1 mm inside.
Scenario edge_through_the_ball(Real inverse_mass_a, Real inverse_mass_b) {
  Scenario scenario = points_at({{-0.012, 0.029, 0}, {0.012, 0.029, 0}}, {inverse_mass_a, inverse_mass_b}, 0);
  scenario.distances = build_distance_set({{0, 1, 0.024, 0}}, 2);
  set_gap(scenario.contact, 2, 0.0005f);
  scenario.contact.captured.edge_sag.assign(scenario.distances.a.size(), 0);
  scenario.contact.released.edge_sag = scenario.contact.captured.edge_sag;
  return scenario;
}

}  // namespace

TEST(FieldContact, the_middle_of_an_edge_keeps_its_own_gap_though_an_end_stays_inside) {
  Scenario scenario = points_at({{0, 0.028, 0}, {0.004, 0.0302, 0}}, {0, 1}, -0.01f);
  scenario.contact.middles = {{0, 1, 0}};
  const Eigen::Vector3f inside = scenario.particles.position(0);
  const auto height = [&] {
    return ((scenario.particles.position(0) + scenario.particles.position(1)) / 2).norm() - radius;
  };
  EXPECT_LT(height(), -5e-4);
  for (int pass = 0; pass < 5; ++pass)
    project_middle_contacts(scenario.contact, scenario.placement, scenario.near, scenario.particles);
  EXPECT_NEAR(height(), 0, 1e-5);
  EXPECT_EQ(scenario.particles.position(0), inside);
  EXPECT_EQ(project_middle_contacts(scenario.contact, scenario.placement, scenario.near, scenario.particles), 0);
}

TEST(FieldContact, both_ends_of_an_edge_go_as_its_middle_has_to) {
  Scenario scenario = points_at({{-0.004, 0.029, 0}, {0.004, 0.029, 0}}, {1, 1}, -0.01f);
  scenario.contact.middles = {{0, 1, -0.0002f}};
  for (int pass = 0; pass < 5; ++pass)
    project_middle_contacts(scenario.contact, scenario.placement, scenario.near, scenario.particles);
  for (const Index end : {0, 1}) EXPECT_NEAR(scenario.particles.position(end).y(), radius - 0.0002, 2e-5);
}

TEST(FieldContact, pushes_an_edge_out_by_its_middle) {
  Scenario scenario = edge_through_the_ball(1, 1);
  scenario.look();
  ASSERT_EQ(scenario.near_edges(), 1);
  EXPECT_EQ(scenario.push_edges(), 1);
  const Eigen::Vector3f middle = (scenario.particles.position(0) + scenario.particles.position(1)) / 2;
  EXPECT_NEAR(middle.norm(), radius + 0.0005, 3e-5);
  EXPECT_NEAR(scenario.particles.position(0).y(), scenario.particles.position(1).y(), 1e-7);
  EXPECT_EQ(scenario.push_particles(), 0) << "the ends were never inside";
}

TEST(FieldContact, the_ends_of_an_edge_share_the_push_at_its_middle_by_their_inverse_masses) {
  Scenario scenario = points_at({{-0.002, 0.029, 0}, {0.002, 0.029, 0}}, {1, 4}, -0.01f);
  scenario.contact.middles = {{0, 1, 0.0005f}};
  EXPECT_EQ(project_middle_contacts(scenario.contact, scenario.placement, scenario.near, scenario.particles), 1);
  const float first = scenario.particles.position(0).y() - 0.029f, second = scenario.particles.position(1).y() - 0.029f;
  EXPECT_NEAR(second / first, 4, 1e-3);
  EXPECT_NEAR((first + second) / 2, 0.0015, 2e-5);
}

TEST(FieldContact, many_edges_at_once_all_leave_a_ball_that_is_elsewhere_and_turned) {
  // Chords of all directions, lengths and depths, some clear of the ball and some beyond the field.
  std::mt19937 random(11);
  std::uniform_real_distribution<Real> uniform(-1, 1);
  const auto direction = [&]() -> Vec3 { return Vec3(uniform(random), uniform(random), uniform(random)).normalized(); };
  const Eigen::Matrix3f rotation(Eigen::AngleAxisf(0.7f, Eigen::Vector3f(1, -2, 1).normalized()));
  const Eigen::Vector3f center(0.2f, -0.1f, 0.05f);
  std::vector<Vec3> ends;
  std::vector<DistanceConstraint> edges;
  for (Index i = 0; i < 100; ++i) {
    const Vec3 outward = direction(), along = outward.cross(direction()).normalized();
    const Vec3 middle = (i % 10 == 9 ? 0.2 : 0.0301 + 0.001 * uniform(random)) * outward;
    const Real half = 0.012 + 0.003 * uniform(random);
    for (const Real side : {-1.0, 1.3}) ends.push_back(center.cast<Real>() + middle + side * half * along);
    edges.push_back({2 * i, 2 * i + 1, 2.3 * half, 0});
  }
  Scenario scenario = points_at(ends, std::vector<Real>(ends.size(), 1), 0);
  scenario.distances = build_distance_set(edges, static_cast<Index>(ends.size()));
  set_gap(scenario.contact, ends.size(), 0.0005f);
  scenario.contact.captured.edge_sag.assign(scenario.distances.a.size(), 0);
  scenario.contact.released.edge_sag = scenario.contact.captured.edge_sag;
  scenario.placement = {rotation, -rotation * center, 0};
  const Particles before = scenario.particles;
  scenario.look();
  EXPECT_GT(scenario.push_edges(), 30);
  for (int i = 0; i < 20; ++i) scenario.push_edges();
  Index moved = 0;
  for (Index i = 0; i < 100; ++i) {
    const Eigen::Vector3f a = scenario.particles.position(2 * i), b = scenario.particles.position(2 * i + 1);
    const float t = std::clamp((center - a).dot(b - a) / (b - a).squaredNorm(), 0.0f, 1.0f);
    EXPECT_GT((a + t * (b - a) - center).norm(), radius + 0.0005 - 5e-5) << i;
    moved += a != Eigen::Vector3f(before.position(2 * i)) ? 1 : 0;
    if (i % 10 == 9) {
      EXPECT_EQ(a, Eigen::Vector3f(before.position(2 * i))) << "far away";
    }
  }
  EXPECT_LT(moved, 90);
}

TEST(FieldContact, a_fixed_end_leaves_the_whole_way_to_the_other) {
  Scenario scenario = edge_through_the_ball(0, 3);
  scenario.look();
  EXPECT_EQ(scenario.push_edges(), 1);
  EXPECT_EQ(scenario.particles.position(0).y(), 0.029f);
  const Eigen::Vector3f middle = (scenario.particles.position(0) + scenario.particles.position(1)) / 2;
  EXPECT_NEAR(middle.norm(), radius + 0.0005, 3e-5);

  Scenario fixed = edge_through_the_ball(0, 0);
  fixed.look();
  EXPECT_EQ(fixed.near_edges(), 0);
}

TEST(FieldContact, an_edge_whose_fixed_end_a_bone_has_come_over_lies_on_it_with_its_middle_and_is_not_thrown_away) {
  // The fixed end is 2 mm below its gap, the other 0.2 mm above it.
  Scenario scenario = points_at({{0, 0.0285, 0}, {0.004, 0.0304, 0}}, {0, 1}, 0.0005f);
  scenario.distances = build_distance_set({{0, 1, 0.0044, 0}}, 2);
  scenario.contact.captured.edge_sag.assign(scenario.distances.a.size(), 0);
  scenario.contact.released.edge_sag = scenario.contact.captured.edge_sag;
  const Particles before = scenario.particles;
  scenario.look();
  for (int pass = 0; pass < 20; ++pass) scenario.push_edges();
  const Eigen::Vector3f middle = (scenario.particles.position(0) + scenario.particles.position(1)) / 2;
  EXPECT_NEAR(middle.norm(), radius, 5e-5) << "a gap there would throw the free end by twice that gap";
  EXPECT_LT(largest_motion(before, scenario.particles), 0.0014);
}

TEST(FieldContact, pushes_an_edge_out_at_its_deepest_point_wherever_that_is) {
  for (const Real share : {0.15, 0.3, 0.5, 0.8}) {
    // Touches the ball's top at `share` of its length, 1 mm deep.
    const Real length = 0.03;
    Scenario scenario = points_at({{-share * length, 0.029, 0}, {(1 - share) * length, 0.029, 0}}, {1, 1}, 0);
    scenario.distances = build_distance_set({{0, 1, length, 0}}, 2);
    scenario.contact.captured.edge_sag.assign(scenario.distances.a.size(), 0);
    scenario.contact.released.edge_sag = scenario.contact.captured.edge_sag;
    scenario.look();
    for (int i = 0; i < 10; ++i) scenario.push_edges();
    const Eigen::Vector3f a = scenario.particles.position(0), b = scenario.particles.position(1);
    float nearest = 1;
    for (int i = 0; i <= 300; ++i) nearest = std::min(nearest, (a + (b - a) * static_cast<float>(i) / 300).norm());
    EXPECT_NEAR(nearest, radius, 5e-5) << "touching at " << share;
  }
}

TEST(FieldContact,
     an_edge_that_tips_over_from_one_ball_onto_another_is_pushed_out_there_once_its_points_are_found_anew) {
  // Balls of 4 mm at x = -10 and 10 mm; the edge first touches the one, then is 0.4 mm deep in the other.
  DistanceField balls = ball();
  for (int k = 0; k < 101; ++k)
    for (int j = 0; j < 101; ++j)
      for (int i = 0; i < 101; ++i) {
        const Vec3 at = balls.origin + 0.001 * Vec3(i, j, k), center(0.01, 0, 0);
        balls.values[static_cast<std::size_t>(i + 101 * (j + 101 * k))] =
            static_cast<float>(std::min((at - center).norm(), (at + center).norm()) - 0.004);
      }
  Scenario scenario = points_at({{-0.022, 0.003, 0}, {0.018, 0.0055, 0}}, {1, 1}, 0);
  scenario.contact.field = bounded(balls);
  scenario.distances = build_distance_set({{0, 1, 0.04, 0}}, 2);
  scenario.contact.captured.edge_sag.assign(scenario.distances.a.size(), 0);
  scenario.contact.released.edge_sag = scenario.contact.captured.edge_sag;
  scenario.look();
  scenario.push_edges();
  scenario.particles.position(0) = Eigen::Vector3f(-0.018f, 0.0055f, 0);
  scenario.particles.position(1) = Eigen::Vector3f(0.022f, 0.003f, 0);
  find_edge_points(scenario.contact, scenario.placement, scenario.particles, scenario.near);
  for (int i = 0; i < 20; ++i) scenario.push_edges();
  const Eigen::Vector3f a = scenario.particles.position(0), b = scenario.particles.position(1);
  const float share = (0.01f - a.x()) / (b.x() - a.x());
  EXPECT_GT(a.y() + share * (b.y() - a.y()), 0.0039f);
}

TEST(FieldContact, an_edge_may_sag_as_at_rest_until_it_is_released) {
  Scenario scenario = edge_through_the_ball(1, 1);
  scenario.contact.captured.edge_sag.assign(scenario.distances.a.size(), -0.0016f);
  scenario.look();
  EXPECT_EQ(scenario.push_edges(), 0);
  scenario.placement.release = 1;
  scenario.look();
  EXPECT_EQ(scenario.push_edges(), 1);
}

TEST(FieldContact, without_edge_gaps_edges_are_not_tested) {
  Scenario scenario = edge_through_the_ball(1, 1);
  scenario.contact.captured.edge_sag.clear();
  scenario.look();
  EXPECT_EQ(scenario.near_edges(), 0);
  EXPECT_EQ(scenario.push_edges(), 0);
}

}  // namespace gracilis
