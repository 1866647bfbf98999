#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/mesh_inspection.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/methods/cylinder/cylinder_method.hpp>
#include <gracilis/methods/cylinder/surface_sections.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/scene/validate.hpp>

#include <scenes_for_tests.hpp>

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
  EXPECT_THAT(validate_method(line_scene(0.05)), testing::IsEmpty());
}

namespace {

Scene surface_scene() {
  Scene scene = tube_scene();
  scene.method.name = "cylinder";
  return scene;
}

Real volume_of(const Scene& scene, const Points& points) {
  return enclosed_volume(points, scene.muscles[0].surface.faces);
}

}  // namespace

TEST(CylinderMethod, a_surface_without_an_action_line_has_sections_across_its_middle) {
  const Muscle muscle = surface_scene().muscles[0];
  const SurfaceSections sections = surface_sections(muscle);
  ASSERT_GE(sections.centers.cols(), 10);
  for (Eigen::Index k = 0; k < sections.centers.cols(); ++k)
    EXPECT_LT((sections.centers.col(k) - Vec3(0.0255, 0, sections.centers(2, k))).norm(), 0.002) << k;
  for (Eigen::Index k = 1; k < sections.centers.cols(); ++k)
    EXPECT_NE(sections.centers(2, k), sections.centers(2, k - 1)) << k;
  for (const Attachment& attachment : muscle.attachments)
    for (const Index v : attachment.vertices)
      EXPECT_EQ(sections.places[v], attachment.end == AttachmentEnd::origin ? 0 : sections.centers.cols() - 1);
}

TEST(CylinderMethod, a_bent_surface_keeps_its_volume_better_than_a_blend_of_the_bones_does) {
  Scene scene = surface_scene();
  EXPECT_THAT(validate_method(scene), testing::IsEmpty());
  const Pose pose = flexed(scene, radians(60));
  const Real rest = volume_of(scene, scene.muscles[0].surface.vertices);
  const Real error = std::abs(volume_of(scene, shape_at(scene, pose)) / rest - 1);
  scene.method.name = "skinning";
  const auto skinning = make_method(scene, [](const DistanceFieldSettings&) { return tube_fields(); });
  skinning->advance(pose, usual_time_step);
  const Real by_skinning = std::abs(volume_of(scene, frame_of(*skinning, pose, 1).muscles[0].points) / rest - 1);
  EXPECT_LT(error, 0.5 * by_skinning);
}

TEST(CylinderMethod, attached_vertices_of_a_surface_go_with_their_bodies_and_nothing_tears_there) {
  const Scene scene = surface_scene();
  const Pose pose = flexed(scene, radians(60));
  const Points points = shape_at(scene, pose);
  const Muscle& muscle = scene.muscles[0];
  const Points& rest = muscle.surface.vertices;
  std::vector<char> is_attached(static_cast<std::size_t>(muscle.surface.vertex_count()), 0);
  for (const Attachment& attachment : muscle.attachments)
    for (const Index v : attachment.vertices) {
      is_attached[static_cast<std::size_t>(v)] = 1;
      const RigidTransform& body = pose.bodies[static_cast<std::size_t>(attachment.body)];
      EXPECT_LT((points.col(v) - body * Vec3(rest.col(v))).norm(), 1e-12);
    }
  for (const MeshEdge& edge : build_topology(muscle.surface.faces, muscle.surface.vertex_count()).edges) {
    if (is_attached[static_cast<std::size_t>(edge.a)] == is_attached[static_cast<std::size_t>(edge.b)]) continue;
    EXPECT_LT((points.col(edge.a) - points.col(edge.b)).norm(), 1.6 * (rest.col(edge.a) - rest.col(edge.b)).norm());
  }
}

TEST(CylinderMethod, a_surface_without_both_ends_follows_its_bodies_and_one_without_any_stays) {
  Scene scene = surface_scene();
  const Points rest = scene.muscles[0].surface.vertices;
  const Pose pose = flexed(scene, radians(20));
  scene.muscles[0].attachments.resize(1);
  const RigidTransform& body = pose.bodies[static_cast<std::size_t>(scene.muscles[0].attachments[0].body)];
  EXPECT_LT((shape_at(scene, pose) - Points(body * rest)).norm(), 1e-9);
  scene.muscles[0].attachments.clear();
  EXPECT_LT((shape_at(scene, pose) - rest).norm(), 1e-12);
}

}  // namespace gracilis
