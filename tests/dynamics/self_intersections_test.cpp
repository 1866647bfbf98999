#include <contact_check/judge.hpp>
#include <gracilis/dynamics/contact/self/unfolding.hpp>

#include <shapes.hpp>

#include "sheet.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace gracilis {
namespace {

using Eigen::Vector3f;

using Pairs = std::vector<FacePair>;

/// A ball of which a particle lies beyond its other side.
constexpr Index spike = 7;
Sheet spiked_ball() {
  Sheet sheet(shapes::sphere(Vec3::Zero(), 0.01, 4));
  sheet.particles.position(spike) *= -1.1f;
  return sheet;
}

/// Fixes a corner of a face that cuts another, not the spike; -1 where nothing cuts itself.
Index fix_beside_spike(Sheet& sheet) {
  const Pairs cuts = sheet.cuts();
  Index fixed = -1;
  if (cuts.empty()) return fixed;
  for (const Index corner : sheet.surface.faces.col(cuts.front()[0]))
    if (corner != spike) fixed = corner;
  sheet.particles.at(fixed)[3] = 0;
  return fixed;
}

/// A triangle in the plane z = 0 and one that stands on its tip in the middle of it, `depth` deep.
TriangleMesh pierced(Real depth) {
  return shapes::mesh_of({{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}, {0, 0, -depth}, {0.2, 0, 1}, {-0.2, 0, 1}},
                         {{0, 1, 2}, {3, 4, 5}});
}

/// Two triangles with a corner in common; the side opposite to it goes through the other where `height` is above 0.
TriangleMesh folded_sheet(Real height) {
  return shapes::mesh_of({{0, 0, 0}, {2, -1, 0}, {2, 1, 0}, {1, 0, -1}, {1, 0, height}}, {{0, 1, 2}, {0, 3, 4}});
}

constexpr float anywhere = std::numeric_limits<float>::infinity();
constexpr float edge = 0.00155f;  // m, about, of a ball of 10 mm in four halvings of an icosahedron's edges

}  // namespace

TEST(SelfIntersections, faces_that_pass_through_each_other_are_found_once_in_whichever_order_they_are_given) {
  Sheet sheet(pierced(-0.1));
  EXPECT_EQ(sheet.cuts(), Pairs());
  sheet.particles.position(3).z() = -0.1f;
  for (const std::vector<Index>& faces : {std::vector<Index>{0, 1}, {1, 0}, {1, 0, 1, 0}})
    EXPECT_EQ(find_self_intersections(sheet.surface, sheet.rest, sheet.before, sheet.particles, faces),
              (Pairs{{0, 1}}));
  EXPECT_EQ(find_self_intersections(sheet.surface, sheet.rest, sheet.before, sheet.particles, {0}), Pairs());
}

TEST(SelfIntersections, faces_with_a_common_corner_cut_when_the_side_opposite_to_it_passes_through) {
  Sheet sheet(folded_sheet(-0.5));
  EXPECT_EQ(sheet.cuts(), Pairs());
  sheet.particles.position(4).z() = 0.5f;
  EXPECT_EQ(sheet.cuts(), (Pairs{{0, 1}}));
}

TEST(SelfIntersections, faces_with_a_common_side_never_cut_even_folded_flat) {
  Sheet sheet(shapes::mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}}, {{0, 1, 2}, {1, 0, 3}}));
  sheet.particles.position(3) = sheet.particles.position(2);
  EXPECT_EQ(sheet.cuts(), Pairs());
}

TEST(SelfIntersections, faces_that_only_touch_or_are_flat_do_not_cut) {
  Sheet sheet(pierced(-0.1));
  sheet.particles.position(3).z() = 0;
  EXPECT_EQ(sheet.cuts(), Pairs());
  for (const Index corner : {3, 4, 5}) sheet.particles.position(corner) = Vector3f(0, 0, -1);
  EXPECT_EQ(sheet.cuts(), Pairs());
}

TEST(SelfIntersections, what_cut_at_rest_and_what_cannot_move_are_left_out) {
  EXPECT_EQ(Sheet(pierced(0.1)).cuts(), Pairs());
  Sheet fixed(pierced(-0.1), 0);
  fixed.particles.position(3).z() = -0.1f;
  EXPECT_EQ(fixed.cuts(), Pairs());
}

TEST(SelfIntersections, a_crumpled_ball_is_judged_as_by_an_independent_program) {
  const TriangleMesh ball = shapes::sphere(Vec3::Zero(), 0.01, 3);
  const contact_check::Judge judge({{"ball", ball, {}}}, {});
  std::mt19937 random(7);
  std::normal_distribution<float> offset(0, 0.0012f);
  for (int trial = 0; trial < 10; ++trial) {
    Sheet sheet(ball);
    for (Index p = 0; p < sheet.particles.count(); ++p)
      sheet.particles.position(p) += Vector3f(offset(random), offset(random), offset(random));
    Points now(3, ball.vertex_count());
    for (Index p = 0; p < now.cols(); ++p) now.col(p) = sheet.particles.position(p).cast<Real>();
    const Index expected = judge.judge(0, {now}, {}).muscles[0].self_pairs;
    EXPECT_GT(expected, 20);
    EXPECT_EQ(static_cast<Index>(sheet.cuts().size()), expected);
  }
}

TEST(SelfIntersections, faces_around_edges_folded_beyond_a_right_angle_are_gathered) {
  Sheet sheet(shapes::sphere(Vec3::Zero(), 0.01, 4));
  std::vector<Index> faces;
  gather_folded(sheet.surface, sheet.particles, faces);
  EXPECT_TRUE(faces.empty());
  sheet.particles.position(7) += Vector3f(-sheet.rest(1, 7), sheet.rest(0, 7), 0).normalized() * 4 * edge;
  gather_folded(sheet.surface, sheet.particles, faces);
  for (Index i = sheet.surface.vertex_faces.offsets[7]; i < sheet.surface.vertex_faces.offsets[8]; ++i)
    EXPECT_GT(std::count(faces.begin(), faces.end(), sheet.surface.vertex_faces.faces[static_cast<std::size_t>(i)]), 0);
  EXPECT_LT(faces.size(), 400u) << "and not the whole ball";
}

TEST(SelfIntersections, faces_turned_by_more_than_a_right_angle_about_their_common_side_have_folded) {
  // Bent at rest by 0, 60 and -60 degrees; the second face turns about the side in the x axis.
  for (const Real bent : {0.0, 60.0, -60.0})
    for (const Real turned : {20.0, 85.0, -85.0, 95.0, -95.0}) {
      const auto apex = [](Real degrees) { return Vec3(0, -std::cos(radians(degrees)), std::sin(radians(degrees))); };
      Sheet sheet(shapes::mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, apex(bent)}, {{0, 1, 2}, {1, 0, 3}}));
      sheet.particles.position(3) = apex(bent + turned).cast<float>();
      // What straightens is no fold.
      const bool has_folded = std::abs(turned) > 90 && std::abs(bent + turned) > 45;
      EXPECT_EQ(sheet.folds(), has_folded ? (Pairs{{0, 1}}) : Pairs()) << bent << " at rest, by " << turned;
    }
}

TEST(SelfIntersections, folds_of_a_crumpled_ball_are_all_edges_that_turned_by_more_than_a_right_angle) {
  Sheet sheet(shapes::sphere(Vec3::Zero(), 0.01, 3));
  std::mt19937 random(8);
  std::normal_distribution<float> offset(0, 0.0005f);
  const Particles before = sheet.particles;
  for (Index p = 0; p < sheet.particles.count(); ++p)
    sheet.particles.position(p) += Vector3f(offset(random), offset(random), offset(random));
  Pairs expected;
  const auto normal = [&](Index face) { return face_area(sheet.surface, face, sheet.particles).normalized(); };
  const auto at_rest = [&](Index face) { return face_area(sheet.surface, face, before).normalized(); };
  for (const ContactSurface::Edge& edge : sheet.surface.edges) {
    // Turned about the edge: by the angle between the normals, less what it was at rest, when it bends the same way.
    const Vector3f along =
        (sheet.particles.position(edge.ends[1]) - sheet.particles.position(edge.ends[0])).normalized();
    const Vector3f then = (before.position(edge.ends[1]) - before.position(edge.ends[0])).normalized();
    const auto turn = [](const Vector3f& left, const Vector3f& right, const Vector3f& about) {
      return std::atan2(left.cross(right).dot(about), left.dot(right));
    };
    const Real by = turn(normal(edge.faces[0]), normal(edge.faces[1]), along) -
                    turn(at_rest(edge.faces[0]), at_rest(edge.faces[1]), then);
    if (std::abs(std::remainder(by, 2 * pi)) > pi / 2)
      expected.push_back({std::min(edge.faces[0], edge.faces[1]), std::max(edge.faces[0], edge.faces[1])});
  }
  std::sort(expected.begin(), expected.end());
  EXPECT_GT(expected.size(), 10u);
  EXPECT_EQ(find_folds(sheet.surface, sheet.rest, before, sheet.particles), expected);
}

TEST(SelfIntersections, what_was_folded_before_the_step_and_what_cannot_move_are_not_unfolded) {
  const TriangleMesh flat = shapes::mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}}, {{0, 1, 2}, {1, 0, 3}});
  for (const Real inverse_mass : {0.0, 1.0}) {
    Sheet sheet(flat, inverse_mass);
    sheet.particles.position(3) = Vector3f(0, 0.9f, 0.3f);
    EXPECT_EQ(sheet.folds().size(), inverse_mass > 0 ? 1u : 0u);
    sheet.before = sheet.particles;
    EXPECT_EQ(sheet.folds(), Pairs());
  }
}

TEST(SelfIntersections, unfolding_returns_a_spike_to_where_the_surface_around_it_was_carried) {
  Eigen::Matrix3f stretch = Eigen::AngleAxisf(0.8f, Vector3f(1, 2, 2) / 3).toRotationMatrix();
  stretch *= Vector3f(1.3f, 0.9f, 1).asDiagonal();
  Sheet sheet(shapes::sphere(Vec3::Zero(), 0.01, 4));
  sheet.carry(stretch, {0.1f, 0, 0});
  const Particles carried = sheet.particles;
  EXPECT_EQ(sheet.cuts(), Pairs());
  sheet.particles.position(7) += 2.2f * (Vector3f(0.1f, 0, 0) - sheet.particles.position(7));
  const Pairs cuts = sheet.cuts();
  ASSERT_FALSE(cuts.empty());
  const float before = largest_motion(carried, sheet.particles);
  for (int attempt = 0; attempt < 4 && !sheet.cuts().empty(); ++attempt)
    unfold(sheet.surface, sheet.rest, sheet.cuts(), anywhere, sheet.particles);
  EXPECT_EQ(sheet.cuts(), Pairs());
  EXPECT_LT(largest_motion(carried, sheet.particles), 0.1f * before);
}

TEST(SelfIntersections, each_cut_by_itself_takes_its_corners_to_where_the_surface_around_it_was_carried) {
  Sheet sheet(shapes::sphere(Vec3::Zero(), 0.01, 4));
  const Eigen::Matrix3f turn = Eigen::AngleAxisf(0.8f, Vector3f(1, 2, 2) / 3).toRotationMatrix();
  sheet.carry(turn, {0.1f, 0, 0});
  const Particles carried = sheet.particles;
  // Particles of two faces far from each other stand out by 3 mm; each of them makes a cut with another face beside it.
  Pairs cuts;
  std::vector<Index> out;
  for (const Index face : {Index{3}, static_cast<Index>(sheet.surface.faces.cols()) - 5}) {
    const Index p = sheet.surface.faces(0, face);
    cuts.push_back({face, sheet.surface.across(0, face)});
    sheet.particles.position(p) *= 1.03f;
    out.push_back(p);
  }
  const float before = largest_motion(carried, sheet.particles);
  ASSERT_GT(before, 0.002f);
  unfold(sheet.surface, sheet.rest, cuts, anywhere, sheet.particles);
  // The map fits some forty particles, one of which is wrong.
  for (const Index p : out) EXPECT_LT((sheet.particles.position(p) - carried.position(p)).norm(), 0.1f * before) << p;
}

TEST(SelfIntersections, a_wrinkle_that_cuts_itself_is_unfolded_and_leaves_the_rest_of_the_surface_alone) {
  Sheet sheet(shapes::sphere(Vec3::Zero(), 0.01, 4));
  std::mt19937 random(3);
  std::normal_distribution<float> offset(0, edge);
  const Vector3f top = sheet.rest.col(0);
  const auto is_near = [&](Index p, float within) { return (sheet.rest.col(p) - top).norm() < within; };
  for (Index p = 0; p < sheet.particles.count(); ++p)
    if (is_near(p, 0.004f)) sheet.particles.position(p) += Vector3f(offset(random), offset(random), offset(random));
  ASSERT_GT(sheet.cuts().size(), 5u);
  for (int attempt = 0; attempt < 6 && !sheet.cuts().empty(); ++attempt)
    unfold(sheet.surface, sheet.rest, sheet.cuts(), anywhere, sheet.particles);
  EXPECT_EQ(sheet.cuts(), Pairs());
  for (Index p = 0; p < sheet.particles.count(); ++p)
    if (!is_near(p, 0.010f)) {
      EXPECT_EQ(Vector3f(sheet.particles.position(p)), Vector3f(sheet.rest.col(p)));
    }
}

TEST(SelfIntersections, smoothing_takes_particles_to_their_neighbors_middle_and_fixed_ones_nowhere) {
  Sheet sheet = spiked_ball();
  const Index fixed = fix_beside_spike(sheet);
  ASSERT_GE(fixed, 0) << "nothing cuts itself";
  const Vector3f stays = sheet.particles.position(fixed);
  for (int rounds = 2; rounds < 20 && !sheet.cuts().empty(); rounds += 2)
    smooth(sheet.surface, sheet.cuts(), rounds, anywhere, sheet.particles);
  EXPECT_EQ(sheet.cuts(), Pairs());
  EXPECT_EQ(Vector3f(sheet.particles.position(fixed)), stays);
}

TEST(SelfIntersections, restoring_the_shape_leaves_a_carried_thin_strand_as_it_is_where_smoothing_wears_it_down) {
  Sheet sheet(shapes::cylinder(0.001, 0.02, 6, 20));
  sheet.carry(Eigen::AngleAxisf(0.7f, Vector3f(1, 2, 2) / 3).toRotationMatrix(), {0.1f, 0, 0});
  const Particles carried = sheet.particles;
  Pairs all;
  for (Index face = 1; face < sheet.surface.faces.cols(); ++face) all.push_back({face - 1, face});
  restore_shape(sheet.surface, sheet.rest, all, 4, anywhere, sheet.particles);
  EXPECT_LT(largest_motion(carried, sheet.particles), 1e-6f);
  smooth(sheet.surface, all, 4, anywhere, sheet.particles);
  EXPECT_GT(largest_motion(carried, sheet.particles), 1e-4f);
}

TEST(SelfIntersections, restoring_the_shape_undoes_a_spike_and_leaves_fixed_particles_where_they_are) {
  Sheet sheet = spiked_ball();
  const Index fixed = fix_beside_spike(sheet);
  ASSERT_GE(fixed, 0) << "nothing cuts itself";
  for (int attempt = 0; attempt < 20 && !sheet.cuts().empty(); ++attempt)
    restore_shape(sheet.surface, sheet.rest, sheet.cuts(), 4, anywhere, sheet.particles);
  EXPECT_EQ(sheet.cuts(), Pairs());
  EXPECT_EQ(Vector3f(sheet.particles.position(fixed)), Vector3f(sheet.rest.col(fixed)));
}

TEST(SelfIntersections, what_cut_before_the_step_is_left_alone) {
  Sheet sheet(pierced(-0.1));
  sheet.particles.position(3).z() = -0.1f;
  ASSERT_EQ(sheet.cuts().size(), 1u);
  sheet.before = sheet.particles;
  EXPECT_EQ(sheet.cuts(), Pairs());
}

TEST(SelfIntersections, untangling_moves_no_particle_further_than_it_may) {
  Sheet unfolded(shapes::sphere(Vec3::Zero(), 0.01, 4));
  unfolded.particles.position(spike) *= -1.2f;
  const Pairs cuts = unfolded.cuts();
  ASSERT_FALSE(cuts.empty());
  Sheet smoothed = unfolded;
  const Particles before = unfolded.particles;
  unfold(unfolded.surface, unfolded.rest, cuts, 0.5f * edge, unfolded.particles);
  EXPECT_NEAR(largest_motion(before, unfolded.particles), 0.5f * edge, 1e-7);
  smooth(smoothed.surface, cuts, 2, 0.5f * edge, smoothed.particles);
  EXPECT_GT(largest_motion(before, smoothed.particles), 0.5f * edge);
  EXPECT_LT(largest_motion(before, smoothed.particles), 2 * 0.5f * edge + 1e-7);
}

TEST(SelfIntersections, a_tangle_that_nothing_can_untangle_is_given_up_soon) {
  Sheet sheet(shapes::sphere(Vec3::Zero(), 0.01, 6));
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(-1, 1);
  for (Index p = 0; p < sheet.particles.count(); ++p)
    sheet.particles.position(p) = Vector3f(place(random), place(random), place(random));
  const std::size_t found = sheet.cuts().size();
  EXPECT_GT(found, 0u);
  // About a third of all pairs cut each other, in hundreds of millions.
  EXPECT_LT(found, 500 * static_cast<std::size_t>(sheet.surface.faces.cols()));
}

TEST(SelfIntersections, with_nothing_to_untangle_nothing_moves) {
  Sheet sheet(shapes::sphere(Vec3::Zero(), 0.01, 3));
  const Particles before = sheet.particles;
  unfold(sheet.surface, sheet.rest, {}, anywhere, sheet.particles);
  smooth(sheet.surface, {}, 4, anywhere, sheet.particles);
  restore_shape(sheet.surface, sheet.rest, {}, 4, anywhere, sheet.particles);
  EXPECT_EQ(largest_motion(before, sheet.particles), 0);
}

}  // namespace gracilis
