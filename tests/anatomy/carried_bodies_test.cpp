#include <gracilis/anatomy/attachments/attachment_patch.hpp>
#include <gracilis/anatomy/attachments/body_carriers.hpp>
#include <gracilis/anatomy/attachments/joined_pieces.hpp>
#include <gracilis/anatomy/attachments/muscle_bodies.hpp>
#include <gracilis/anatomy/joints/blended_bodies.hpp>

#include "anatomy/muscles_for_tests.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace gracilis {
namespace {

using testing::ElementsAre;

/// A tube along z whose lower end body 1 holds and whose upper end body 2.
Muscle held_tube() {
  Muscle muscle = tube_muscle();
  muscle.attachments[0].body = 1;
  muscle.attachments[1].body = 2;
  return muscle;
}

MeshTopology topology_of(const Muscle& muscle) {
  return build_topology(muscle.surface.faces, muscle.surface.vertex_count());
}

RigidTransform turned(Real angle, const Vec3& axis, const Vec3& shift) {
  RigidTransform motion = RigidTransform::Identity();
  motion.linear() = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  motion.translation() = shift;
  return motion;
}

Pose pose_of(const RigidTransform& first, const RigidTransform& second) {
  Pose pose = capture_pose(3);
  pose.bodies[1] = first;
  pose.bodies[2] = second;
  return pose;
}

Scene scene_of(const std::vector<Muscle>& muscles) {
  Scene scene;
  scene.bodies = {"ground", "lower", "upper"};
  scene.muscles = muscles;
  return scene;
}

}  // namespace

TEST(BodyCarriers, hold_attached_vertices_and_share_the_others) {
  const Muscle muscle = held_tube();
  const BodyCarriers carriers = body_carriers(muscle, topology_of(muscle), 0);
  EXPECT_THAT(carriers.bodies, ElementsAre(1, 2));
  const std::vector<char> held = held_vertices(carriers);
  for (Index v = 0; v < muscle.surface.vertex_count(); ++v) {
    const Real z = muscle.surface.vertices(2, v);
    const Index body = z < 1e-9 ? 1 : z > 0.2 - 1e-9 ? 2 : -1;
    EXPECT_EQ(carriers.fixed_body[static_cast<std::size_t>(v)], body);
    EXPECT_EQ(held[static_cast<std::size_t>(v)] != 0, body >= 0);
    EXPECT_NEAR(carriers.weights.col(v).sum(), 1, 1e-5);
  }
}

TEST(BodyCarriers, what_no_attachment_reaches_is_held_where_it_is) {
  Muscle muscle = held_tube();
  muscle.surface = shapes::both(muscle.surface, shapes::sphere({1, 0, 0}, 0.01, 1));
  muscle.attachments.clear();
  const BodyCarriers carriers = body_carriers(muscle, topology_of(muscle), 0);
  for (const char each : held_vertices(carriers)) EXPECT_TRUE(each);
  const Pose pose = pose_of(turned(1, Vec3::UnitX(), {1, 0, 0}), turned(1, Vec3::UnitX(), {1, 0, 0}));
  for (const RigidTransform& motion : carried_motions(carriers, pose))
    EXPECT_TRUE(motion.isApprox(RigidTransform::Identity()));
}

TEST(BodyCarriers, attached_vertices_go_with_their_body_and_all_do_where_all_bodies_move_alike) {
  const Muscle muscle = held_tube();
  const BodyCarriers carriers = body_carriers(muscle, topology_of(muscle), 0);
  const RigidTransform first = turned(0.4, {1, 2, 3}, {0.1, 0, 0.02}), second = turned(-0.3, {0, 1, 1}, {0, 0.05, 0});
  const Points apart = moved_by(carried_motions(carriers, pose_of(first, second)), muscle.surface.vertices);
  const Points together = moved_by(carried_motions(carriers, pose_of(first, first)), muscle.surface.vertices);
  for (Index v = 0; v < muscle.surface.vertex_count(); ++v) {
    const Vec3 rest = muscle.surface.vertices.col(v);
    EXPECT_LT((together.col(v) - first * rest).norm(), 1e-9);
    const Index body = carriers.fixed_body[static_cast<std::size_t>(v)];
    if (body < 0) continue;
    EXPECT_EQ(apart.col(v), (body == 1 ? first : second) * rest);
  }
}

TEST(BodyCarriers, half_way_between_two_bodies_is_their_mean_motion) {
  const Muscle muscle = held_tube();
  const BodyCarriers carriers = body_carriers(muscle, topology_of(muscle), 0);
  const Vec3 shift(0, 0.06, 0);
  const Pose pose = pose_of(RigidTransform::Identity(), turned(0, Vec3::UnitX(), shift));
  const Points moved = moved_by(carried_motions(carriers, pose), muscle.surface.vertices);
  std::vector<Index> middle;
  for (Index v = 0; v < muscle.surface.vertex_count(); ++v)
    if (std::abs(muscle.surface.vertices(2, v) - 0.1) < 1e-9) middle.push_back(v);
  ASSERT_EQ(middle.size(), 40u);
  for (const Index v : middle) EXPECT_LT((moved.col(v) - muscle.surface.vertices.col(v) - shift / 2).norm(), 1e-3);
  const std::vector<RigidTransform> some = carried_motions(carriers, pose, middle);
  for (std::size_t i = 0; i < middle.size(); ++i)
    EXPECT_EQ(some[i] * Vec3(muscle.surface.vertices.col(middle[i])), moved.col(middle[i]));
}

TEST(BodyCarriers, a_shape_carried_on_and_back_is_the_same_and_at_attachments_that_of_rest) {
  const Muscle muscle = held_tube();
  const BodyCarriers carriers = body_carriers(muscle, topology_of(muscle), 0);
  const Points& rest = muscle.surface.vertices;
  Points bulged = rest;
  bulged.topRows(2) *= 1.2;
  const Pose here = pose_of(turned(0.1, {1, 0, 0}, {0, 0, 0.01}), turned(0.2, {0, 1, 0}, {0.02, 0, 0})),
             there = pose_of(turned(0.4, {1, 2, 3}, {0.1, 0, 0}), turned(-0.3, {0, 1, 1}, {0, 0.1, 0}));
  const Points on = carried_on(carriers, rest, here, there, bulged), back = carried_on(carriers, rest, there, here, on);
  for (Index v = 0; v < muscle.surface.vertex_count(); ++v) {
    const Index body = carriers.fixed_body[static_cast<std::size_t>(v)];
    const Vec3 expected =
        body >= 0 ? Vec3(here.bodies[static_cast<std::size_t>(body)] * Vec3(rest.col(v))) : Vec3(bulged.col(v));
    EXPECT_LT((back.col(v) - expected).norm(), 1e-12);
  }
}

TEST(MuscleBodies, move_with_what_lies_around_them_and_have_its_shares) {
  Scene scene = scene_of({held_tube()});
  const Points& x = scene.muscles[0].surface.vertices;
  Points end(3, 1);
  end << 0.016, 0, 0.15;
  EXPECT_EQ(add_muscle_body(scene, "tendon", 0, end), 3);
  ASSERT_EQ(scene.muscle_bodies.size(), 1u);
  const MuscleBody& body = scene.muscle_bodies[0];
  EXPECT_EQ(scene.bodies[3], "tendon");
  EXPECT_TRUE(std::is_sorted(body.patch.begin(), body.patch.end()));
  // Edges are 2.5 mm along and 2.36 mm around, their diagonals 3.4 mm: three mean ones are about 8.2 mm.
  for (Index v = 0; v < x.cols(); ++v) {
    const Real away = (Vec3(x.col(v)) - Vec3(0.015, 0, 0.15)).norm();
    const bool is_listed = std::binary_search(body.patch.begin(), body.patch.end(), v);
    EXPECT_TRUE(is_listed || away > 0.0078) << away;
    EXPECT_TRUE(!is_listed || away < 0.0088) << away;
  }
  EXPECT_THAT(body.bodies, ElementsAre(1, 2));
  EXPECT_NEAR(body.shares[1], 0.75, 0.02) << "three quarters of the way to the upper body";
  EXPECT_NEAR(body.shares[0] + body.shares[1], 1, 1e-6);
  EXPECT_LT((body.center - Vec3(0.0147, 0, 0.15)).norm(), 5e-4);
}

TEST(MuscleBodies, go_rigidly_with_their_patch_where_the_muscle_tells) {
  Scene scene = scene_of({held_tube()});
  Points end(3, 1);
  end << 0.016, 0, 0.15;
  add_muscle_body(scene, "tendon", 0, end);
  const std::vector<CarriedBody> carried = carried_bodies(scene);
  ASSERT_EQ(carried.size(), 1u);
  const RigidTransform motion = turned(0.7, {1, 2, 3}, {0.1, 0.2, 0.3});
  Points now = scene.muscles[0].surface.vertices;
  for (const Index v : carried[0].patch) now.col(v) = motion * Vec3(now.col(v));
  EXPECT_TRUE(motion_of(carried[0], now).isApprox(motion, 1e-9));
  Pose pose = capture_pose(4);
  place_carried_bodies(
      carried, {1}, [&](std::size_t) { return &now; }, pose);
  EXPECT_TRUE(pose.bodies[3].isApprox(RigidTransform::Identity())) << "of another muscle";
  place_carried_bodies(
      carried, {0}, [](std::size_t) -> const Points* { return nullptr; }, pose);
  EXPECT_TRUE(pose.bodies[3].isApprox(RigidTransform::Identity())) << "nobody knows";
  place_carried_bodies(
      carried, {0}, [&](std::size_t) { return &now; }, pose);
  EXPECT_TRUE(pose.bodies[3].isApprox(motion, 1e-9));
}

TEST(MuscleBodies, hosts_come_before_their_guests) {
  Scene scene = scene_of({held_tube(), held_tube(), held_tube(), held_tube()});
  Points end(3, 1);
  end << 0.016, 0, 0.15;
  // 3 lies on 1, which lies on 2.
  scene.muscles[1].attachments[1].body = add_muscle_body(scene, "on 2", 2, end);
  scene.muscles[3].attachments[1].body = add_muscle_body(scene, "on 1", 1, end);
  const std::vector<std::vector<std::size_t>> groups = hosts_first(scene);
  ASSERT_EQ(groups.size(), 3u);
  EXPECT_THAT(groups[0], ElementsAre(0u, 2u));
  EXPECT_THAT(groups[1], ElementsAre(1u));
  EXPECT_THAT(groups[2], ElementsAre(3u));
  EXPECT_EQ(hosts_first(scene_of({held_tube()})).size(), 1u);
}

TEST(MuscleBodies, a_place_beside_a_host_is_its_nearest_point_and_the_way_from_there) {
  const TriangleMesh box = shapes::box({0, 0, 0}, {1, 1, 1});
  const NearestTriangle tree(box);
  const Vec3 point(0.3, 0.4, 1.25);
  const HostPlace place = host_place(tree, box.faces, point);
  EXPECT_LT((place.offset - Vec3(0, 0, 0.25)).norm(), 1e-12);
  Vec3 below = Vec3::Zero();
  for (std::size_t k = 0; k < 3; ++k)
    below += place.weights[static_cast<Index>(k)] * box.vertices.col(place.corners[k]);
  EXPECT_LT((below + place.offset - point).norm(), 1e-12);
}

TEST(BlendedBodies, go_where_their_shares_of_the_bodies_carry_them_about_their_center) {
  Scene scene = scene_of({});
  scene.bodies.emplace_back("carried");
  scene.muscle_bodies.push_back({3, 0, {}, {1, 2}, {0.25, 0.75}, Vec3(0.1, 0, 0)});
  Pose pose = pose_of(turned(0, Vec3::UnitX(), {0.04, 0, 0}), turned(0, Vec3::UnitX(), {0, 0.08, 0}));
  pose.bodies.push_back(turned(1, Vec3::UnitX(), {1, 1, 1}));
  place_by_bodies(scene, pose);
  EXPECT_LT((pose.bodies[3] * Vec3(0.1, 0, 0) - Vec3(0.11, 0.06, 0)).norm(), 1e-12);
  // Both turned about the center: so is it, by the mean angle.
  const auto about_center = [](Real angle) {
    return RigidTransform(Eigen::Translation3d(0.1, 0, 0) * turned(angle, Vec3::UnitZ(), Vec3::Zero()) *
                          Eigen::Translation3d(-0.1, 0, 0));
  };
  pose.bodies[1] = about_center(0);
  pose.bodies[2] = about_center(0.4);
  place_by_bodies(scene, pose);
  EXPECT_TRUE(pose.bodies[3].isApprox(about_center(0.3), 1e-3)) << "blends of quaternions err by the angle's cube";
  pose.bodies[2] = RigidTransform::Identity();
  place_by_bodies(scene, pose);
  EXPECT_EQ(pose.bodies[3].matrix(), RigidTransform::Identity().matrix()) << "to the last bit";
}

TEST(BlendedBodies, turn_and_go_at_the_mean_of_their_shares) {
  Scene scene = scene_of({});
  scene.muscle_bodies.push_back({3, 0, {}, {1, 2}, {0.25, 0.75}, Vec3::Zero()});
  std::vector<Twist> twists(4);
  twists[1] = {Vec3(4, 0, 0), Vec3(0, 8, 0)};
  twists[2] = {Vec3(0, 4, 0), Vec3(0, 0, 4)};
  twists[3] = {Vec3(9, 9, 9), Vec3(9, 9, 9)};
  add_twists(scene, twists);
  EXPECT_LT((twists[3].velocity - Vec3(1, 3, 0)).norm(), 1e-15);
  EXPECT_LT((twists[3].turning - Vec3(0, 2, 3)).norm(), 1e-15);
}

TEST(JoinedPieces, a_piece_that_not_all_bodies_hold_hangs_on_what_it_lies_on) {
  // A long box that two bodies hold, a small one on it that the first holds alone, and one far away that nothing does.
  const TriangleMesh surface =
      shapes::both(shapes::both(shapes::box({0, 0, 0}, {10, 1, 1}), shapes::box({0, 0, 1.1}, {1, 1, 2})),
                   shapes::box({0, 0, 50}, {1, 1, 51}));
  const MeshTopology topology = build_topology(surface.faces, surface.vertex_count());
  std::vector<Index> fixed(24, -1);
  fixed[0] = 0, fixed[1] = 1, fixed[8] = 0;
  const MeshTopology joined = joined_pieces(surface, topology, fixed);
  std::vector<std::pair<Index, Index>> bridges;
  for (const MeshEdge& edge : joined.edges)
    if (edge.left < 0 && edge.right < 0) bridges.emplace_back(edge.a, edge.b);
  EXPECT_TRUE(std::is_sorted(joined.edges.begin(), joined.edges.end(), [](const MeshEdge& l, const MeshEdge& r) {
    return std::pair(l.a, l.b) < std::pair(r.a, r.b);
  }));
  const auto joins = [&](Index a, Index b) {
    return std::find(bridges.begin(), bridges.end(), std::pair(a, b)) != bridges.end();
  };
  // Corners 4 and 6 of the long box lie right under corners 8 and 10 of the small one.
  EXPECT_TRUE(joins(4, 8) && joins(6, 10));
  for (const auto& [a, b] : bridges) {
    ASSERT_LT(a, b);
    EXPECT_FALSE(a >= 16) << "what holds to nothing holds nobody";
    const auto begin = joined.stars.neighbors.begin();
    const auto around_a = std::vector<Index>(begin + joined.stars.offsets[static_cast<std::size_t>(a)],
                                             begin + joined.stars.offsets[static_cast<std::size_t>(a) + 1]);
    EXPECT_TRUE(std::binary_search(around_a.begin(), around_a.end(), b));
    const auto around_b = std::vector<Index>(begin + joined.stars.offsets[static_cast<std::size_t>(b)],
                                             begin + joined.stars.offsets[static_cast<std::size_t>(b) + 1]);
    EXPECT_TRUE(std::binary_search(around_b.begin(), around_b.end(), a));
  }
  EXPECT_TRUE(std::any_of(bridges.begin(), bridges.end(), [](const auto& each) { return each.second >= 16; }))
      << "the far one follows, too";
  EXPECT_EQ(joined.edges.size(), topology.edges.size() + bridges.size());
}

TEST(JoinedPieces, pieces_that_all_bodies_hold_and_surfaces_in_one_piece_stay_as_they_are) {
  const TriangleMesh two = shapes::both(shapes::box({0, 0, 0}, {10, 1, 1}), shapes::box({0, 0, 1.1}, {1, 1, 2}));
  const MeshTopology topology = build_topology(two.faces, two.vertex_count());
  std::vector<Index> fixed(16, -1);
  EXPECT_EQ(joined_pieces(two, topology, fixed).edges.size(), topology.edges.size()) << "nothing is held";
  fixed[0] = 0, fixed[1] = 1, fixed[8] = 0, fixed[9] = 1;
  EXPECT_EQ(joined_pieces(two, topology, fixed).edges.size(), topology.edges.size());
  fixed[9] = -1;
  EXPECT_GT(joined_pieces(two, topology, fixed).edges.size(), topology.edges.size());
}

TEST(AttachmentPatch, each_piece_belongs_to_the_bone_that_it_lies_nearest_to_on_average) {
  const TriangleMesh left = shapes::box({-1, 0, -1}, {0, 1, 0}), right = shapes::box({2, 0, -1}, {3, 1, 0});
  const NearestTriangle left_tree(left), right_tree(right);
  const NearestTriangle* bones[] = {&left_tree, &right_tree};
  // Two pieces: one over the left bone with a tip over the right one, one over the right.
  const TriangleMesh patch = shapes::mesh_of(
      {{-0.5, 0, 0.1}, {0, 1, 0.1}, {-0.5, 1, 0.1}, {2.2, 0.5, 0.1}, {2.1, 0, 0.1}, {2.9, 0, 0.1}, {2.5, 1, 0.1}},
      {{0, 1, 2}, {0, 3, 1}, {4, 5, 6}});
  EXPECT_THAT(bones_under(patch, bones), ElementsAre(0u, 0u, 1u));
  const TriangleMesh kept = kept_faces(patch, {1, 0, 1});
  EXPECT_EQ(kept.vertices, patch.vertices);
  EXPECT_EQ(kept.faces, (Eigen::Matrix3Xi(3, 2) << 0, 4, 1, 5, 2, 6).finished());
}

}  // namespace gracilis
