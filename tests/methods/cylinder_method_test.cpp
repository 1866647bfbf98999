#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/mesh_inspection.hpp>
#include <gracilis/methods/cylinder/cylinder_method.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/scene/validate.hpp>

#include "line_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis {

static Points shape_at(const Scene& scene, const Pose& pose) {
  const auto method = make_cylinder_method(scene);
  method->advance(pose, usual_time_step);
  Frame frame;
  method->write(frame);
  return frame.muscles[0].points;
}

static Pose at(const Scene& scene, Real flexion, Real slide) {
  return pose_at(scene, std::vector<Real>{flexion, slide});
}

TEST(CylinderMethod, at_the_capture_pose_the_surface_is_the_input) {
  const Scene scene = line_scene(0.05);
  ASSERT_THAT(validate(scene), testing::IsEmpty());
  EXPECT_LT((shape_at(scene, at(scene, 0, 0)) - scene.muscles[0].surface.vertices).norm(), 1e-14);
}

TEST(CylinderMethod, rigid_motion_of_all_bodies_moves_the_surface_rigidly) {
  const Scene scene = line_scene(0.05);
  const RigidTransform by = Eigen::Translation3d(0.1, -0.2, 0.3) * Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized());
  Pose pose = at(scene, 0.7, 0), moved = pose;
  for (RigidTransform& body : moved.bodies) body = by * body;
  EXPECT_LT((shape_at(scene, moved) - by * shape_at(scene, pose)).norm(), 1e-13);
}

TEST(CylinderMethod, ends_stay_on_their_bodies) {
  const Scene scene = line_scene(0);
  const Pose pose = at(scene, 0.5, 0.01);
  const Points points = shape_at(scene, pose);
  const ActionLine& line = scene.muscles[0].action_line;
  EXPECT_LT((points.col(points.cols() - 2) - line.points.col(0)).norm(), 1e-14);
  EXPECT_LT((points.col(points.cols() - 1) - pose.bodies[1] * line.points.col(2)).norm(), 1e-14);
}

TEST(CylinderMethod, a_stretched_muscle_keeps_its_volume_and_its_tendon_its_length) {
  const Scene scene = line_scene(0.06);
  const Points stretched = shape_at(scene, at(scene, 0, -0.03));
  const TriangleMesh& rest = scene.muscles[0].surface;
  const Real before = inspect_mesh(rest).volume, after = inspect_mesh({stretched, rest.faces}).volume;
  EXPECT_NEAR(after / before, 1, 0.01);
  // The last sections' distance from the end.
  const auto from_end = [](const Points& points, Index k) {
    return (points.middleCols(8 * k, 8).rowwise().mean() - points.col(points.cols() - 1)).norm();
  };
  for (Index k = 13; k < 16; ++k) EXPECT_NEAR(from_end(stretched, k), from_end(rest.vertices, k), 2e-4) << k;
  EXPECT_GT(from_end(stretched, 8), from_end(rest.vertices, 8) + 0.01);
}

TEST(CylinderMethod, only_the_present_pose_counts_for_any_number_of_threads) {
  const Scene scene = line_scene(0.05);
  const Points direct = shape_at(scene, at(scene, 0.9, 0.01));
  const ThreadLimit limit(1);
  const auto method = make_cylinder_method(scene);
  for (const Real flexion : {0.2, -0.4, 1.3, 0.9}) method->advance(at(scene, flexion, 0.01), usual_time_step);
  Frame frame;
  method->write(frame);
  EXPECT_EQ(frame.muscles[0].points, direct);
}

TEST(CylinderMethod, a_surface_that_is_not_made_of_the_lines_sections_is_refused) {
  Scene scene = line_scene(0.05);
  scene.muscles[0].action_line.scaling = 2;
  ASSERT_EQ(validate(scene).size(), 1u);
  EXPECT_THAT(validate(scene)[0].what, testing::HasSubstr("9 sections and two ends have 74"));
  scene.muscles[0].action_line = {};
  EXPECT_THAT(validate(scene), testing::IsEmpty());
  ASSERT_EQ(validate_method(scene).size(), 1u);
  EXPECT_THAT(validate_method(scene)[0].what, testing::HasSubstr("needs its action line"));
}

}  // namespace gracilis
