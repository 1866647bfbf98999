#include <gracilis/dynamics/havlicek_2024/virtual_edges.hpp>

#include "millimeter.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace gracilis {
namespace {

using Eigen::Vector3f;

/// One particle, and where it was before.
struct Point {
  Particles now, before;
  Point(const Vec3& position, const Vec3& previous, Real inverse_mass)
      : now(make_particles(position, Eigen::VectorXd::Constant(1, inverse_mass))),
        before(make_particles(previous, Eigen::VectorXd::Constant(1, inverse_mass))) {}
};

bool part(Point& first, Point& second, EdgeResolution resolution, const Vector3f& shift = Vector3f::Zero()) {
  return part_ends({0, 0}, resolution, 2 * mm, shift, first.before, second.before, first.now, second.now);
}

}  // namespace

TEST(VirtualEdgeDirection, the_plain_push_goes_along_the_edge_wherever_the_ends_were) {
  const Vector3f now(0, 0, 1 * mm), before(3 * mm, 0, 1 * mm);
  EXPECT_TRUE(parting_direction(EdgeResolution::push, now, before, 2 * mm).isApprox(Vector3f(0, 0, 1)));
}

TEST(VirtualEdgeDirection, leans_toward_the_way_back_by_unit_vectors_or_by_vectors_as_they_are) {
  const Vector3f now(0, 0, 1 * mm), before(3 * mm, 0, 1 * mm);
  EXPECT_TRUE(
      parting_direction(EdgeResolution::unit_sum, now, before, 2 * mm).isApprox(Vector3f(1, 0, 1) / std::sqrt(2.0f)));
  EXPECT_TRUE(parting_direction(EdgeResolution::vector_sum, now, before, 2 * mm)
                  .isApprox(Vector3f(3, 0, 2) / std::sqrt(13.0f)));
}

TEST(VirtualEdgeDirection, an_end_that_passed_the_other_goes_back_where_its_way_was_longer_than_the_contact_distance) {
  const Vector3f now(0, 0, -0.5f * mm);
  const auto direction = [&](EdgeResolution resolution, float before) {
    return parting_direction(resolution, now, {0, 0, before}, 2 * mm).z();
  };
  EXPECT_FLOAT_EQ(direction(EdgeResolution::push, 2.5f * mm), -1) << "the plain push drives it on";
  EXPECT_FLOAT_EQ(direction(EdgeResolution::vector_sum, 2.5f * mm), 1);
  EXPECT_FLOAT_EQ(direction(EdgeResolution::vector_sum, 1.0f * mm), -1);
  EXPECT_FLOAT_EQ(direction(EdgeResolution::unit_sum, 2.5f * mm), -1) << "the sum vanishes: the plain push is left";
}

TEST(VirtualEdgeDirection, ends_in_one_place_part_as_they_were_before_or_not_at_all) {
  for (const auto resolution : {EdgeResolution::push, EdgeResolution::unit_sum, EdgeResolution::vector_sum}) {
    const Vector3f none = Vector3f::Zero();
    EXPECT_TRUE(parting_direction(resolution, none, {0, 3 * mm, 0}, 2 * mm).isApprox(Vector3f(0, 1, 0)));
    EXPECT_TRUE(parting_direction(resolution, none, none, 2 * mm).isZero());
  }
}

TEST(VirtualEdgePush, equal_ends_move_by_half_of_what_is_missing) {
  Point first({0, 0, 0.0005}, {0, 0, 0.0005}, 1), second({0, 0, 0}, {0, 0, 0}, 1);
  EXPECT_TRUE(part(first, second, EdgeResolution::push));
  EXPECT_TRUE(first.now.position(0).isApprox(Vector3f(0, 0, 1.25f * mm)));
  EXPECT_TRUE(second.now.position(0).isApprox(Vector3f(0, 0, -0.75f * mm)));
}

TEST(VirtualEdgePush, unequal_ends_move_by_their_inverse_masses_and_keep_momentum) {
  for (const auto resolution : {EdgeResolution::push, EdgeResolution::unit_sum, EdgeResolution::vector_sum}) {
    const Vec3 a(0.0003, 0.0002, 0.0005), b(0, 0.0001, 0);
    Point first(a, {0.002, 0, 0.001}, 1), second(b, {0, 0, -0.001}, 3);
    EXPECT_TRUE(part(first, second, resolution));
    const Vector3f one = first.now.position(0) - a.cast<float>(), other = second.now.position(0) - b.cast<float>();
    EXPECT_LT((one + other / 3).norm(), 1e-9f) << "m₁ Δx₁ + m₂ Δx₂";
    EXPECT_GT(one.norm(), 1e-4f);
    EXPECT_NEAR((first.now.position(0) - second.now.position(0)).norm(), 0.002, 1e-8);
  }
}

TEST(VirtualEdgePush, by_the_way_back_the_ends_come_to_lie_across_the_edge) {
  Point first({0, 0, 0.001}, {0.003, 0, 0.001}, 1), second({0, 0, 0}, {0, 0, 0}, 1);
  EXPECT_TRUE(part(first, second, EdgeResolution::vector_sum));
  // About the midpoint (0, 0, 0.5 mm), by 1 mm along (3, 0, 2)/√13.
  EXPECT_TRUE(first.now.position(0).isApprox(Vector3f(0.83205f, 0, 1.05470f) * mm, 1e-4f));
  EXPECT_TRUE(second.now.position(0).isApprox(Vector3f(-0.83205f, 0, -0.05470f) * mm, 1e-4f));
}

TEST(VirtualEdgePush, a_fixed_end_leaves_all_motion_to_the_other) {
  Point first({0, 0, 0.001}, {0, 0, 0.001}, 0), second({0, 0, 0}, {0, 0, 0}, 2);
  EXPECT_TRUE(part(first, second, EdgeResolution::push));
  EXPECT_TRUE(first.now.position(0).isApprox(Vector3f(0, 0, 1 * mm)));
  EXPECT_TRUE(second.now.position(0).isApprox(Vector3f(0, 0, -1 * mm)));
  Point fixed({0, 0, 0}, {0, 0, 0}, 0);
  EXPECT_FALSE(part(first, fixed, EdgeResolution::push));
}

TEST(VirtualEdgePush, the_common_motion_of_both_ends_changes_nothing) {
  const Vec3 common(0.04, -0.02, 0.03);
  for (const auto resolution : {EdgeResolution::push, EdgeResolution::unit_sum, EdgeResolution::vector_sum}) {
    Point first({0.001, 0, 0.001}, {0.003, 0, 0.001}, 1), second({0, 0, 0}, {0, 0, 0}, 1);
    Point carried({0.001, 0, 0.001}, Vec3(0.003, 0, 0.001) - common, 1), with({0, 0, 0}, -common, 1);
    part(first, second, resolution);
    part(carried, with, resolution);
    EXPECT_LT((first.now.position(0) - carried.now.position(0)).norm(), 1e-7f);
  }
}

TEST(VirtualEdgePush, acts_in_the_coordinates_of_each_surface) {
  Point first({0, 0, 0}, {0, 0, 0}, 1), second({0.1, 0, 0}, {0.1, 0, 0}, 1);
  EXPECT_TRUE(part(first, second, EdgeResolution::push, {0.1f, 0, 0.5f * mm}));
  EXPECT_TRUE(first.now.position(0).isApprox(Vector3f(0, 0, 0.75f * mm), 1e-4f));
  EXPECT_NEAR(second.now.position(0).z(), -0.00075, 1e-8);
}

}  // namespace gracilis
