#include <gracilis/geometry/signed_distance.hpp>
#include <gracilis/methods/tissue/neighbors.hpp>
#include <gracilis/methods/tissue/tissue_method.hpp>

#include <scenes_for_tests.hpp>

#include <gtest/gtest.h>

namespace gracilis {
namespace {

using namespace tissue;

/// A tube of 160 mm, held by a body of its own at either end.
Muscle tube_between(const std::string& name, const RigidTransform& place, Index first_body, Index around) {
  Muscle muscle;
  muscle.name = name;
  muscle.surface = shapes::cylinder(0.01, 0.16, around, 2 * around);
  muscle.surface.vertices.row(2).array() -= 0.08;
  Attachment origin{"one end", AttachmentEnd::origin, first_body, {}, false};
  Attachment insertion{"other end", AttachmentEnd::insertion, first_body + 1, {}, false};
  for (Index v = 0; v < muscle.surface.vertex_count(); ++v) {
    if (muscle.surface.vertices(2, v) > 0.07) origin.vertices.push_back(v);
    if (muscle.surface.vertices(2, v) < -0.07) insertion.vertices.push_back(v);
  }
  muscle.attachments = {origin, insertion};
  muscle.surface.vertices = (place.linear() * muscle.surface.vertices).colwise() + place.translation();
  return muscle;
}

/// Two tubes that cross each other in their middles, `gap` apart.
Scene crossing_tubes(Real gap, Index around = 24) {
  Scene scene;
  scene.name = "crossing";
  scene.bodies = {"a", "b", "c", "d"};
  const RigidTransform across = Eigen::Translation3d(0.02 + gap, 0, 0) * Eigen::AngleAxisd(pi / 2, Vec3::UnitX());
  scene.muscles = {tube_between("still", RigidTransform::Identity(), 0, around),
                   tube_between("moved", across, 2, around)};
  scene.method.name = "tissue";
  scene.method.settings = {{"minimizer_iterations", 60}, {"tension_frames", 1}};
  return scene;
}

Pose pressed(Real by) {
  Pose pose;
  pose.bodies.assign(4, RigidTransform::Identity());
  for (const std::size_t body : {2, 3}) pose.bodies[body].translation().x() = -by;
  return pose;
}

/// How deep the deepest vertex of one is in the other, m.
Real depth(const Scene& scene, const Frame& frame, std::size_t one, std::size_t other) {
  const SignedDistance distance({frame.muscles[other].points, scene.muscles[other].surface.faces});
  Real deepest = 0;
  for (const Vec3& p : frame.muscles[one].points.colwise()) deepest = std::max(deepest, -distance.query(p).distance);
  return deepest;
}

Real depth_after_pressing(const Scene& scene, Real by) {
  const auto method = make_tissue_method(scene, {});
  Frame frame;
  for (int step = 1; step <= 10; ++step) {
    method->advance(pressed(by * step / 10), usual_time_step);
    frame = frame_of(*method, pressed(by), step);
  }
  return std::max(depth(scene, frame, 0, 1), depth(scene, frame, 1, 0));
}

TEST(TissueNeighbors, muscles_that_are_pressed_together_give_way_instead_of_passing_through_each_other) {
  Scene scene = crossing_tubes(0.001);
  EXPECT_LT(depth_after_pressing(scene, 0.006), 5e-4);
  scene.method.settings["contact_rounds"] = 0;
  EXPECT_GT(depth_after_pressing(scene, 0.006), 3e-3) << "nothing was pressed";
}

TEST(TissueNeighbors, what_overlaps_in_the_capture_pose_may_stay) {
  Scene scene = crossing_tubes(-0.003);
  scene.method.settings["fiber_tension"] = 0.0;
  scene.method.settings["fiber_stiffness"] = 0.0;
  const auto method = make_tissue_method(scene, {});
  const Frame before = frame_of(*method, pressed(0), 0);
  method->advance(pressed(0), usual_time_step);
  EXPECT_LT(farthest(frame_of(*method, pressed(0), 1), before), 1e-5);
}

TEST(TissueNeighbors, planes_lie_midway_and_face_away_from_the_other) {
  const Scene scene = crossing_tubes(0.001);
  Neighbors neighbors = prepare_neighbors(scene, {0.0005, 0.0005});
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

TEST(TissueNeighbors, muscles_press_on_each_other_with_the_same_force) {
  // What each presses by is summed over its own vertices, so these have to be close.
  Scene scene = crossing_tubes(0.001, 60);
  scene.method.settings["contact_rounds"] = 8;
  scene.method.settings["minimizer_iterations"] = 800;
  scene.method.settings["minimizer_residual"] = 1e-6;
  const auto method = make_tissue_method(scene, {});
  for (int step = 1; step <= 12; ++step) method->advance(pressed(0.006 * std::min(step, 8) / 8), usual_time_step);
  const std::vector<MuscleForces> forces = method->muscle_forces({});
  ASSERT_EQ(forces[0].muscles.size(), 1U);
  const Vec3 on_moved = forces[0].muscles[0].wrench.force, on_still = forces[1].muscles[0].wrench.force;
  EXPECT_GT(on_moved.x(), 0.3) << "the still one pushes the moved one back";
  EXPECT_LT((on_moved + on_still).norm(), 0.05 * on_moved.norm());
}

TEST(TissueNeighbors, planes_far_from_the_origin_are_the_same) {
  const Scene scene = crossing_tubes(0.001);
  Neighbors neighbors = prepare_neighbors(scene, {0.0005, 0.0005});
  std::vector<Points> shapes = {scene.muscles[0].surface.vertices, scene.muscles[1].surface.vertices};
  const std::vector<std::vector<ContactPlane>> near = contact_planes(neighbors, shapes);
  const Vec3 by(3000, -2000, 1000);
  for (Points& shape : shapes) shape.colwise() += by;
  const std::vector<std::vector<ContactPlane>> far = contact_planes(neighbors, shapes);
  ASSERT_EQ(far[0].size(), near[0].size());
  for (std::size_t i = 0; i < near[0].size(); ++i)
    EXPECT_NEAR(far[0][i].least - far[0][i].normal.dot(by), near[0][i].least, 1e-6);
}

}  // namespace
}  // namespace gracilis
