#include <gracilis/dynamics/contact/field/field_contact.hpp>

#include "around_a_ball.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace gracilis {
namespace {

/// A triangle wider than the ball whose plane lies `height` above the ball's center; its last corner is fixed.
Scenario face_over_the_ball(Real height) {
  const Real width = 0.03;
  Points corners(3, 3);
  for (int k = 0; k < 3; ++k)
    corners.col(k) = Vec3(width * std::cos(2 * pi * k / 3) + 0.003, height, width * std::sin(2 * pi * k / 3));
  Scenario scenario = points_at({corners.col(0), corners.col(1), corners.col(2)}, {1, 1, 0}, 0.0005f);
  scenario.faces = build_face_set(Eigen::Vector3i(0, 1, 2), 3);
  scenario.contact.captured.face_sag = scenario.contact.released.face_sag = {0};
  scenario.look();
  return scenario;
}

}  // namespace

TEST(FieldContact, pushes_a_face_out_where_the_obstacle_pokes_through_between_its_edges) {
  Scenario scenario = face_over_the_ball(0.029);
  ASSERT_EQ(scenario.near.faces.count(), 1);
  for (int i = 0; i < 10; ++i) scenario.push_faces();
  const Eigen::Vector3f where = scenario.near.faces.where[0];
  Eigen::Vector3f deepest = Eigen::Vector3f::Zero();
  for (int k = 0; k < 3; ++k) deepest += where[k] * scenario.particles.position(k);
  EXPECT_NEAR(deepest.norm(), radius + 0.0005, 1e-4);
  EXPECT_EQ(scenario.particles.position(2).y(), 0.029f) << "a fixed corner";
}

TEST(FieldContact, the_corners_of_a_face_share_the_push_by_their_weights_and_inverse_masses) {
  const std::vector<Vec3> corners = {{0.006, 0.029, 0}, {-0.004, 0.029, 0.005}, {-0.003, 0.029, -0.006}};
  Scenario scenario = points_at(corners, {1, 2, 5}, 0.0005f);
  scenario.faces = build_face_set(Eigen::Vector3i(0, 1, 2), 3);
  scenario.contact.captured.face_sag = scenario.contact.released.face_sag = {0};
  scenario.look();
  ASSERT_EQ(scenario.near.faces.count(), 1);
  const Particles before = scenario.particles;
  EXPECT_EQ(scenario.push_faces(), 1);
  const Eigen::Vector3f where = scenario.near.faces.where[0];
  Eigen::Vector3f deepest = Eigen::Vector3f::Zero();
  std::array<float, 3> share{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Index p = scenario.faces.particles[k][0];
    const Eigen::Vector3f moved = scenario.particles.position(p) - before.position(p);
    share[k] = moved.norm() / (where[static_cast<Index>(k)] * before.inverse_mass(p));
    deepest += where[static_cast<Index>(k)] * scenario.particles.position(p);
    EXPECT_GT(moved.y(), 0);
  }
  EXPECT_NEAR(share[1] / share[0], 1, 1e-3);
  EXPECT_NEAR(share[2] / share[0], 1, 1e-3);
  EXPECT_NEAR(deepest.norm(), radius + 0.0005, 2e-5) << "at once, but for the field's bend";
}

TEST(FieldContact, a_face_whose_fixed_corner_is_inside_is_not_thrown_away) {
  Scenario scenario = points_at({{0, 0.029, 0}, {0.008, 0.0302, 0}, {0, 0.0302, 0.008}}, {0, 1, 1}, 0.0005f);
  scenario.faces = build_face_set(Eigen::Vector3i(0, 1, 2), 3);
  scenario.contact.captured.face_sag = scenario.contact.released.face_sag = {0};
  const Particles before = scenario.particles;
  for (int pass = 0; pass < 20; ++pass) scenario.look(), scenario.push_faces();
  // The fixed corner is 1.5 mm below its gap; what can move has to follow by no more than a lever of 1 to 1 makes of
  // it.
  EXPECT_LT(largest_motion(before, scenario.particles), 0.0015 / 0.5);
  EXPECT_GT(largest_motion(before, scenario.particles), 0);
}

TEST(FieldContact, a_face_that_was_clear_is_pushed_once_it_has_come_down) {
  Scenario scenario = face_over_the_ball(radius + 0.0015);
  ASSERT_EQ(scenario.near.faces.count(), 1);
  EXPECT_EQ(scenario.push_faces(), 0);
  for (int k = 0; k < 3; ++k) scenario.particles.position(k).y() -= 0.0008f;
  EXPECT_EQ(scenario.push_faces(), 0) << "0.2 mm above its gap";
  for (int k = 0; k < 3; ++k) scenario.particles.position(k).y() -= 0.0004f;
  EXPECT_EQ(scenario.push_faces(), 1);
}

TEST(FieldContact, a_face_that_comes_in_from_outside_of_the_field_is_pushed) {
  Scenario scenario = face_over_the_ball(0.058);
  ASSERT_EQ(scenario.near.faces.count(), 1);
  ASSERT_FALSE(std::isfinite(sample(scenario.contact.field.grid, {0, 0.058f, 0}).distance));
  EXPECT_EQ(scenario.push_faces(), 0);
  for (int k = 0; k < 3; ++k) scenario.particles.position(k).y() = 0.03f;
  EXPECT_EQ(scenario.push_faces(), 1);
}

TEST(FieldContact, faces_of_one_color_share_no_particle) {
  const TriangleMesh mesh = shapes::sphere(Vec3::Zero(), 1, 3);
  const FaceSet set = build_face_set(mesh.faces, mesh.vertex_count());
  EXPECT_EQ(set.count(), mesh.face_count());
  Index covered = 0;
  for (const ColorRange& color : set.colors) {
    std::vector<Index> used;
    for (Index slot = color.begin; slot < color.end; ++slot)
      for (const auto& column : set.particles) used.push_back(column[static_cast<std::size_t>(slot)]);
    std::sort(used.begin(), used.end());
    EXPECT_EQ(std::adjacent_find(used.begin(), used.end()), used.end());
    covered += color.end - color.begin;
  }
  EXPECT_EQ(covered, mesh.face_count());
}

}  // namespace gracilis
