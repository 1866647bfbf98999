#include <gracilis/geometry/measures.hpp>
#include <gracilis/methods/tissue/tissue_method.hpp>
#include <gracilis/simulate/measures.hpp>

#include <scenes_for_tests.hpp>

#include <gtest/gtest.h>

/// What is seen of a muscle whose triangles are larger than the cells in it.
namespace gracilis {
namespace {

const SettingValues converged = {{"tension_frames", 1}, {"minimizer_iterations", 400}, {"minimizer_residual", 1e-5}};

/// The tube of `tube_scene` with triangles 20 to 30 mm long.
Scene coarse_tube() {
  Scene scene = tube_scene();
  Muscle& muscle = scene.muscles[0];
  muscle.surface = shapes::cylinder(0.01, 0.16, 6, 8);
  muscle.surface.vertices.colwise() += Vec3(0.0255, 0, -0.08);
  for (Attachment& attachment : muscle.attachments) {
    attachment.vertices.clear();
    for (Index v = 0; v < muscle.surface.vertex_count(); ++v) {
      const Real z = muscle.surface.vertices(2, v);
      if (attachment.end == AttachmentEnd::origin ? z > 0.07 : z < -0.07) attachment.vertices.push_back(v);
    }
  }
  scene.method.name = "tissue";
  scene.method.settings = converged;
  return scene;
}

Real volume_ratio(const Scene& scene, const Frame& frame) {
  const TriangleMesh& surface = scene.muscles[0].surface;
  return enclosed_volume(frame.muscles[0].points, surface.faces) / enclosed_volume(surface.vertices, surface.faces);
}

TEST(TissueSeenSurface, a_coarse_sheet_that_is_twisted_encloses_what_the_tissue_in_it_does) {
  Scene scene = coarse_tube();
  scene.bones.clear();
  // A sheet 5 mm thick. Its flat triangles would come nearer to each other where it is twisted.
  scene.muscles[0].surface.vertices.row(0).array() -= 0.0255;
  scene.muscles[0].surface.vertices.row(0) *= 0.25;
  const auto method = make_tissue_method(scene, {});
  for (int frame = 1; frame <= 12; ++frame) {
    Pose pose;
    pose.bodies = {RigidTransform::Identity(), RigidTransform(Eigen::AngleAxisd(radians(10 * frame), Vec3::UnitZ()))};
    method->advance(pose, usual_time_step);
    EXPECT_NEAR(volume_ratio(scene, frame_of(*method, pose, frame)), 1, 0.005) << frame;
  }
}

TEST(TissueSeenSurface, a_coarse_tube_that_is_bent_around_bones_keeps_its_volume_and_its_triangles_stay_out_of_them) {
  const Scene scene = coarse_tube();
  const auto method = make_tissue_method(scene, tube_fields());
  Measurer measurer(scene);
  Points last = scene.muscles[0].surface.vertices;
  for (int frame = 1; frame <= 45; ++frame) {
    const Pose pose = flexed(scene, radians(2 * frame));
    method->advance(pose, usual_time_step);
    const Frame made = frame_of(*method, pose, frame);
    const MuscleMeasures measures = measurer.measure(made)[0];
    EXPECT_NEAR(measures.volume_ratio, 1, 0.005) << frame;
    EXPECT_LT(measures.vertex_depth_beyond_rest, 1e-4) << frame;
    EXPECT_LT(measures.midpoint_depth_beyond_rest, 5e-4) << frame;
    // The lower end moves by 3 mm; nothing jumps.
    EXPECT_LT((made.muscles[0].points - last).colwise().norm().maxCoeff(), 0.0045) << frame;
    last = made.muscles[0].points;
  }
}

}  // namespace
}  // namespace gracilis
