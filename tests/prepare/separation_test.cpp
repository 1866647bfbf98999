#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/nearest_triangle.hpp>
#include <gracilis/prepare/cgal.hpp>
#include <gracilis/prepare/separation.hpp>
#include <gracilis/prepare/smoothing.hpp>
#include <gracilis/prepare/thickness.hpp>

#include "shapes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace gracilis {
namespace {

using shapes::box;
using shapes::mm;
using shapes::sphere;

Index crossings(const TriangleMesh& a, const TriangleMesh& b) {
  const std::array<const TriangleMesh*, 2> both = {&a, &b};
  return static_cast<Index>(intersecting_faces(both).size());
}

Real gap_between(const TriangleMesh& a, const TriangleMesh& b) {
  const NearestTriangle nearest(b);
  Real least = 1;
  for (Index v = 0; v < a.vertex_count(); ++v) least = std::min(least, nearest.query(a.vertices.col(v)).distance);
  return least;
}

Real farthest_moved(const TriangleMesh& before, const TriangleMesh& after) {
  return (after.vertices - before.vertices).colwise().norm().maxCoeff();
}

TEST(Separation, of_two_overlapping_spheres_each_gives_way_half) {
  // Mirror images of each other in the plane x = 0; they overlap by 2 mm.
  TriangleMesh left = sphere(Vec3(-19 * mm, 0, 0), 20 * mm, 4);
  TriangleMesh right = left;
  right.vertices.row(0) *= -1;
  right.faces.row(0).swap(right.faces.row(1));
  ASSERT_GT(crossings(left, right), 0);
  std::vector<TriangleMesh> muscles = {left, right};
  const SeparationResult result = separate(muscles, {}, {.muscle_gap = 0.3 * mm});
  EXPECT_EQ(result.missed, 0);
  EXPECT_EQ(crossings(muscles[0], muscles[1]), 0);
  EXPECT_GT(gap_between(muscles[0], muscles[1]), 0.25 * mm);
  const Real moved_left = farthest_moved(left, muscles[0]), moved_right = farthest_moved(right, muscles[1]);
  EXPECT_NEAR(moved_left, moved_right, 0.05 * mm);
  EXPECT_NEAR(moved_left, 1.15 * mm, 0.3 * mm);
  // Where they were apart they stay as they were.
  Index far_left = 0;
  left.vertices.row(0).minCoeff(&far_left);
  EXPECT_LT((muscles[0].vertices.col(far_left) - left.vertices.col(far_left)).norm(), 0.01 * mm);
}

TEST(Separation, bones_stay_and_muscles_give_way_wholly) {
  const TriangleMesh bone = box(Vec3(-50, -50, -50) * mm, Vec3(50, 50, 0) * mm);
  const TriangleMesh ball = sphere(Vec3(0, 0, 18 * mm), 20 * mm, 4);
  std::vector<TriangleMesh> muscles = {ball};
  ASSERT_GT(crossings(ball, bone), 0);
  const SeparationResult result = separate(muscles, {bone}, {.bone_gap = 0.5 * mm});
  EXPECT_EQ(result.missed, 0);
  EXPECT_EQ(crossings(muscles[0], bone), 0);
  EXPECT_GT(muscles[0].vertices.row(2).minCoeff(), 0.44 * mm);
  EXPECT_NEAR(enclosed_volume(muscles[0].vertices, muscles[0].faces) / enclosed_volume(ball.vertices, ball.faces), 1,
              0.03);
}

TEST(Separation, moves_nothing_where_all_gaps_are_there) {
  const TriangleMesh a = sphere(Vec3(-21 * mm, 0, 0), 20 * mm, 3), b = sphere(Vec3(21 * mm, 0, 0), 20 * mm, 3);
  std::vector<TriangleMesh> muscles = {a, b};
  const SeparationResult result = separate(muscles, {}, {.muscle_gap = 0.3 * mm});
  EXPECT_EQ(result.rounds, 0);
  EXPECT_EQ(muscles[0].vertices, a.vertices);
  EXPECT_EQ(muscles[1].vertices, b.vertices);
}

TEST(Separation, of_what_is_apart_already_is_the_identity) {
  std::vector<TriangleMesh> muscles = {sphere(Vec3(-19 * mm, 0, 0), 20 * mm, 4),
                                       sphere(Vec3(19 * mm, 0, 0), 20 * mm, 4)};
  separate(muscles, {}, {});
  const std::vector<TriangleMesh> once = muscles;
  separate(muscles, {}, {});
  for (std::size_t m = 0; m < 2; ++m) EXPECT_LT(farthest_moved(once[m], muscles[m]), 0.01 * mm);
}

TEST(Separation, moves_no_vertex_by_more_than_twice_the_worst_overlap_even_where_it_cannot_succeed) {
  // The ball is held between two bones that leave less room than it needs.
  const TriangleMesh below = box(Vec3(-50, -50, -50) * mm, Vec3(50, 50, -17) * mm);
  const TriangleMesh above = box(Vec3(-50, -50, 17) * mm, Vec3(50, 50, 50) * mm);
  const TriangleMesh aside = box(Vec3(-50, -50, -17) * mm, Vec3(-17, 50, 17) * mm);
  const TriangleMesh ball = sphere(Vec3::Zero(), 20 * mm, 4);
  std::vector<TriangleMesh> muscles = {ball};
  const SeparationResult result = separate(muscles, {below, above, aside}, {});
  ASSERT_EQ(result.lacked.size(), 1u);
  EXPECT_NEAR(result.lacked[0], 3.3 * mm, 0.1 * mm);
  EXPECT_LE(farthest_moved(ball, muscles[0]), 2 * result.lacked[0] * (1 + 1e-9));
  EXPECT_NEAR(result.moved[0], farthest_moved(ball, muscles[0]), 1e-12);
}

TEST(Separation, what_stays_is_as_a_bone_and_lies_in_others_that_stay_unasked) {
  const TriangleMesh left = sphere(Vec3(-18 * mm, 0, 0), 20 * mm, 4), middle = sphere(Vec3(18 * mm, 0, 0), 20 * mm, 4),
                     right = sphere(Vec3(54 * mm, 0, 0), 20 * mm, 4);
  std::vector<TriangleMesh> muscles = {left, middle, right};
  const std::vector<Index> none;
  const SeparationResult result = separate(muscles, {}, {.apart_from = {std::nullopt, none, none}});
  EXPECT_EQ(muscles[1].vertices, middle.vertices);
  EXPECT_EQ(muscles[2].vertices, right.vertices);
  EXPECT_GT(farthest_moved(left, muscles[0]), 3.9 * mm) << "the overlap is 4 mm deep";
  EXPECT_EQ(result.missed, 0);
  EXPECT_LT(result.shortfall, 0.05 * mm);
}

TEST(Separation, keeps_within_what_is_allowed) {
  const TriangleMesh bone = box(Vec3(-50, -50, -50) * mm, Vec3(50, 50, 0) * mm);
  const TriangleMesh ball = sphere(Vec3(0, 0, 18 * mm), 20 * mm, 4);
  std::vector<TriangleMesh> muscles = {ball};
  EXPECT_GT(separate(muscles, {bone}, {.at_most = {0.5 * mm}}).missed, 0);
  EXPECT_LE(farthest_moved(ball, muscles[0]), 0.5 * mm * (1 + 1e-9));
}

TEST(Thickness, a_volume_is_set_and_a_thin_part_gives_less_than_a_thick_one) {
  TriangleMesh ball = sphere(Vec3::Zero(), 20 * mm, 4);
  const Real volume = enclosed_volume(ball.vertices, ball.faces);
  set_volume(ball, 0.9 * volume);
  EXPECT_NEAR(enclosed_volume(ball.vertices, ball.faces) / volume, 0.9, 1e-3);
  TriangleMesh spindle = sphere(Vec3::Zero(), 20 * mm, 5);
  for (auto p : spindle.vertices.colwise()) {
    const Real thin = 1 - 0.8 * std::abs(p.z()) / (20 * mm);
    p.x() *= thin, p.y() *= thin, p.z() *= 3;
  }
  const TriangleMesh before = spindle;
  set_volume(spindle, 0.9 * enclosed_volume(before.vertices, before.faces));
  Real middle = 0, end = 0;
  for (Index v = 0; v < before.vertex_count(); ++v) {
    const Real moved = (spindle.vertices.col(v) - before.vertices.col(v)).norm(), z = std::abs(before.vertices(2, v));
    if (z < 5 * mm) middle = std::max(middle, moved);
    if (z > 50 * mm) end = std::max(end, moved);
  }
  EXPECT_LT(end, 0.5 * middle);
}

TEST(Smoothing, a_spike_is_rounded_off_and_the_rest_stays) {
  TriangleMesh ball = sphere(Vec3::Zero(), 20 * mm, 4);
  Index top = 0, bottom = 0;
  ball.vertices.row(2).maxCoeff(&top);
  ball.vertices.row(2).minCoeff(&bottom);
  ball.vertices(2, top) += 8 * mm;
  const TriangleMesh spiked = ball;
  ASSERT_GT(sharp_edge_count(ball, radians(60)), 0);
  EXPECT_EQ(round_off(ball, radians(60), 50, 10 * mm), 0);
  EXPECT_EQ(sharp_edge_count(ball, radians(60)), 0);
  EXPECT_LT(ball.vertices(2, top), spiked.vertices(2, top) - 3 * mm);
  EXPECT_EQ(ball.vertices.col(bottom), spiked.vertices.col(bottom));
}

TEST(Smoothing, noise_goes_and_volume_stays) {
  TriangleMesh ball = sphere(Vec3::Zero(), 20 * mm, 4);
  const Real volume = enclosed_volume(ball.vertices, ball.faces);
  for (Index v = 0; v < ball.vertex_count(); ++v) ball.vertices.col(v) *= 1 + 0.02 * std::sin(7919.0 * v);
  const auto roughness = [&] {
    const Eigen::RowVectorXd radii = ball.vertices.colwise().norm();
    return std::sqrt((radii.array() - radii.mean()).square().mean());
  };
  const Real rough = roughness();
  smooth_surface(ball, 10);
  EXPECT_LT(roughness(), 0.35 * rough);
  EXPECT_NEAR(enclosed_volume(ball.vertices, ball.faces) / volume, 1, 0.01);
}

}  // namespace
}  // namespace gracilis
