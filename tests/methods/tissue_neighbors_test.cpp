#include <gracilis/geometry/signed_distance.hpp>
#include <gracilis/methods/tissue/neighbors.hpp>
#include <gracilis/methods/tissue/tissue_method.hpp>

#include <scenes_for_tests.hpp>

#include "held_tubes.hpp"

#include <gtest/gtest.h>

namespace gracilis {
namespace {

using namespace tissue;

Pose pressed(Real by) {
  Pose pose;
  pose.bodies.assign(4, RigidTransform::Identity());
  for (const std::size_t body : {2, 3}) pose.bodies[body].translation().x() = -by;
  return pose;
}

Real depth_after_pressing(const Scene& scene, Real by, Real activation = 0) {
  const auto method = make_tissue_method(scene, {});
  Frame frame;
  for (int step = 1; step <= 10; ++step) {
    Pose pose = pressed(by * step / 10);
    pose.activations.assign(scene.muscles.size(), activation);
    method->advance(pose, usual_time_step);
    frame = frame_of(*method, pressed(by), step);
  }
  return std::max(depth(scene, frame, 0, 1), depth(scene, frame, 1, 0));
}

TEST(TissueNeighbors, muscles_that_are_pressed_together_give_way_instead_of_passing_through_each_other) {
  Scene scene = held_tubes_across(0.001);
  EXPECT_LT(depth_after_pressing(scene, 0.006), 5e-4);
  scene.method.settings["contact_rounds"] = 0;
  EXPECT_GT(depth_after_pressing(scene, 0.006), 3e-3) << "nothing was pressed";
}

TEST(TissueNeighbors, what_is_seen_of_muscles_keeps_apart_however_soft_their_contact_is) {
  Scene scene = held_tubes_across(0.001, 40);
  scene.method.settings["neighbor_stiffness"] = 1e7;
  EXPECT_LT(depth_after_pressing(scene, 0.004), 2e-4);
}

TEST(TissueNeighbors, active_muscles_press_harder_and_come_no_deeper_into_each_other) {
  Scene scene = held_tubes_across(0.001);
  const Real deepest = depth_after_pressing(scene, 0.006, 1);
  scene.method.settings["neighbor_per_tension"] = 0.0;
  const Real soft = depth_after_pressing(scene, 0.006, 1);
  EXPECT_LT(deepest, 5e-4);
  EXPECT_GT(soft, 2 * deepest);
}

TEST(TissueNeighbors, a_jump_after_small_steps_is_met_as_one_from_rest) {
  const Scene scene = held_tubes_across(0.001);
  const auto depth_after = [&](int small_steps) {
    const auto method = make_tissue_method(scene, {});
    for (int step = 1; step <= small_steps; ++step) method->advance(pressed(1e-5 * step), usual_time_step);
    method->advance(pressed(0.006), usual_time_step);
    const Frame frame = frame_of(*method, pressed(0.006), 1);
    return std::max(depth(scene, frame, 0, 1), depth(scene, frame, 1, 0));
  };
  EXPECT_LT(depth_after(5), depth_after(0) + 1e-4);
}

TEST(TissueNeighbors, what_overlaps_in_the_capture_pose_may_stay) {
  Scene scene = held_tubes_across(-0.003);
  scene.method.settings["fiber_tension"] = 0.0;
  scene.method.settings["fiber_stiffness"] = 0.0;
  const auto method = make_tissue_method(scene, {});
  const Frame before = frame_of(*method, pressed(0), 0);
  method->advance(pressed(0), usual_time_step);
  EXPECT_LT(farthest(frame_of(*method, pressed(0), 1), before), 1e-5);
}

TEST(TissueNeighbors, planes_lie_midway_and_face_away_from_the_other) {
  const Scene scene = held_tubes_across(0.001);
  Neighbors neighbors = prepare_neighbors(scene, {{0.0005}, {0.0005}});
  std::vector<Points> shapes = {scene.muscles[0].surface.vertices, scene.muscles[1].surface.vertices};
  shapes[1].row(0).array() -= 0.003;  // 2 mm into each other
  const std::vector<std::vector<ContactPlane>> planes = contact_planes(neighbors, shapes);
  Real nearest = 1;
  for (const ContactPlane& plane : planes[1]) {
    const Vec3 p = shapes[1].col(plane.point);
    if (std::abs(p.y()) > 0.001) continue;
    EXPECT_GT(plane.normal.x(), 0.9);
    nearest = std::min(nearest, plane.normal.dot(p) - plane.least);
  }
  EXPECT_NEAR(nearest, -(0.002 + 0.0005) / 2, 2e-4);
}

TEST(TissueNeighbors, what_moves_little_finds_all_planes_that_it_may_come_to) {
  const Scene scene = held_tubes_across(0.001);
  Neighbors neighbors = prepare_neighbors(scene, {{0.0005}, {0.0005}});
  std::vector<Points> shapes = {scene.muscles[0].surface.vertices, scene.muscles[1].surface.vertices};
  for (const Real deep : {-0.001, 0.0005, 0.004}) {
    std::vector<Points> pressed_shapes = shapes;
    pressed_shapes[1].row(0).array() -= 0.001 + deep;
    constexpr Real move = 0.0004;
    const std::vector<std::vector<ContactPlane>> all = contact_planes(neighbors, pressed_shapes),
                                                 few =
                                                     contact_planes(neighbors, pressed_shapes, {.largest_move = move});
    for (std::size_t m = 0; m < 2; ++m) {
      auto found = few[m].begin();
      for (const ContactPlane& plane : all[m]) {
        if (plane.normal.dot(pressed_shapes[m].col(plane.point)) - plane.least >= move) continue;
        found = std::find_if(found, few[m].end(), [&](const ContactPlane& each) { return each.point == plane.point; });
        ASSERT_NE(found, few[m].end()) << "vertex " << plane.point << " at " << deep;
        EXPECT_EQ(found->least, plane.least);
      }
    }
    EXPECT_LE(few[0].size(), all[0].size());
    if (deep < 0) {
      EXPECT_LT(few[0].size(), all[0].size());
    }
  }
}

/// The force that the two are off by once they have come to rest, over the one that they press by.
Real unbalanced_share(Scene scene, const std::vector<Real>& activations = {}, int steps = 12) {
  scene.method.settings["contact_rounds"] = 8;
  scene.method.settings["minimizer_iterations"] = 800;
  scene.method.settings["minimizer_residual"] = 1e-6;
  const auto method = make_tissue_method(scene, {});
  for (int step = 1; step <= steps; ++step) {
    Pose pose = pressed(0.006 * std::min(step, 8) / 8);
    pose.activations = activations;
    method->advance(pose, usual_time_step);
  }
  const std::vector<MuscleForces> forces = method->muscle_forces({});
  const Vec3 on_moved = forces.at(0).muscles.at(0).wrench.force, on_still = forces.at(1).muscles.at(0).wrench.force;
  EXPECT_GT(on_moved.x(), 0.3) << "the still one pushes the moved one back";
  return (on_moved + on_still).norm() / on_moved.norm();
}

TEST(TissueNeighbors, muscles_press_on_each_other_with_the_same_force) {
  EXPECT_LT(unbalanced_share(held_tubes_across(0.001, 60)), 0.005);
}

TEST(TissueNeighbors, so_they_do_where_one_is_active_and_the_other_is_not) {
  // Between a stiff one and a soft one planes come to rest more slowly: 0.14 after 12 steps.
  EXPECT_LT(unbalanced_share(held_tubes_across(0.001, 60), {1, 0}, 20), 0.005);
}

TEST(TissueNeighbors, muscles_of_unlike_triangles_press_on_each_other_with_the_same_force) {
  Scene scene = held_tubes_across(0.001);
  scene.muscles[0] = tube_between("still", RigidTransform::Identity(), 0, 40);
  EXPECT_LT(unbalanced_share(scene), 0.005);  // 0.16 where each sums over its own vertices alone
}

TEST(TissueNeighbors, planes_far_from_the_origin_are_the_same) {
  const Scene scene = held_tubes_across(0.001);
  Neighbors neighbors = prepare_neighbors(scene, {{0.0005}, {0.0005}});
  std::vector<Points> shapes = {scene.muscles[0].surface.vertices, scene.muscles[1].surface.vertices};
  const std::vector<std::vector<ContactPlane>> near = contact_planes(neighbors, shapes);
  const Vec3 by(3000, -2000, 1000);
  for (Points& shape : shapes) shape.colwise() += by;
  const std::vector<std::vector<ContactPlane>> far = contact_planes(neighbors, shapes);
  ASSERT_EQ(far[0].size(), near[0].size());
  for (std::size_t i = 0; i < near[0].size(); ++i)
    EXPECT_NEAR(far[0][i].least - far[0][i].normal.dot(by), near[0][i].least, 1e-6);
}

/// A tube in the shape of a U, whose legs are 50 mm long and 10 mm apart; a body holds the top of each.
Scene horseshoe() {
  constexpr Real radius = 0.008, bend = 0.013, leg = 0.05;
  Scene scene;
  scene.name = "horseshoe";
  scene.bodies = {"a", "b"};
  Muscle muscle;
  muscle.name = "horseshoe";
  muscle.surface = shapes::cylinder(radius, 2 * leg + pi * bend, 20, 56);
  for (Index v = 0; v < muscle.surface.vertex_count(); ++v) {
    const Vec3 p = muscle.surface.vertices.col(v);
    const Real angle = pi + std::clamp((p.z() - leg) / bend, 0.0, pi);
    const Real beyond = p.z() < leg ? leg - p.z() : std::max(0.0, p.z() - leg - pi * bend);
    const Vec3 out(std::cos(angle), 0, std::sin(angle));
    muscle.surface.vertices.col(v) = (bend + p.x()) * out + Vec3(0, p.y(), beyond);
  }
  Attachment origin{"one leg", AttachmentEnd::origin, 0, {}, false};
  Attachment insertion{"other leg", AttachmentEnd::insertion, 1, {}, false};
  for (Index v = 0; v < muscle.surface.vertex_count(); ++v)
    if (muscle.surface.vertices(2, v) > leg - 0.006)
      (muscle.surface.vertices(0, v) < 0 ? origin : insertion).vertices.push_back(v);
  muscle.attachments = {origin, insertion};
  scene.muscles = {muscle};
  scene.method.name = "tissue";
  scene.method.settings = {
      {"minimizer_iterations", 60}, {"tension_frames", 1}, {"cell_size", 0.004}, {"cells_at_least", 0}};
  return scene;
}

/// How deep the second leg of the horseshoe is in the first, m.
Real depth_of_legs(const Scene& scene, const Points& now) {
  const TriangleMesh& rest = scene.muscles[0].surface;
  const auto is_of_leg = [&](Index v, Real side) {
    return rest.vertices(2, v) > 0.005 && side * rest.vertices(0, v) > 0;
  };
  TriangleMesh first{now, Eigen::Matrix3Xi(3, 0)};
  for (const Eigen::Vector3i face : rest.faces.colwise())
    if (std::all_of(face.begin(), face.end(), [&](Index v) { return is_of_leg(v, -1); })) {
      first.faces.conservativeResize(3, first.faces.cols() + 1);
      first.faces.rightCols<1>() = face;
    }
  const SignedDistance distance(first);
  Real deepest = 0;
  for (Index v = 0; v < rest.vertex_count(); ++v)
    if (is_of_leg(v, 1)) deepest = std::max(deepest, -distance.query(now.col(v)).distance);
  return deepest;
}

TEST(TissueNeighbors, legs_of_one_muscle_that_are_drawn_across_each_other_give_way_and_do_not_pass_through) {
  Scene scene = horseshoe();
  const auto depth_after = [&] {
    const auto method = make_tissue_method(scene, {});
    Real deepest = 0;
    for (int step = 1; step <= 48; ++step) {
      Pose pose;
      pose.bodies.assign(2, RigidTransform::Identity());
      // The second leg's top goes behind the first leg's, past it, and then back to the front, where the leg is in the
      // way.
      const auto done = [&](int from, int to) { return std::clamp(Real(step - from) / (to - from), 0.0, 1.0); };
      pose.bodies[1].translation() = Vec3(-0.043 * done(8, 28), 0.017 * done(0, 8) - 0.021 * done(28, 48), 0);
      method->advance(pose, usual_time_step);
      deepest = std::max(deepest, depth_of_legs(scene, frame_of(*method, pose, step).muscles[0].points));
    }
    return deepest;
  };
  EXPECT_LT(depth_after(), 1e-3);
  scene.method.settings["self_contact"] = false;
  EXPECT_GT(depth_after(), 3e-3) << "nothing was pressed";
}

TEST(TissueNeighbors, what_a_muscle_does_to_itself_is_no_force_on_another) {
  const Scene scene = horseshoe();
  const auto method = make_tissue_method(scene, {});
  method->advance({0, {}, std::vector<RigidTransform>(2, RigidTransform::Identity()), {}}, usual_time_step);
  EXPECT_TRUE(method->muscle_forces({})[0].muscles.empty());
}

}  // namespace
}  // namespace gracilis
