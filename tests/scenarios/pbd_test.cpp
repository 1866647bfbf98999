#include <gracilis/anatomy/builtin/builtin_hip.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/scene/motion.hpp>

#include "scenario_runs.hpp"

/// Position based dynamics as published (Cervenka and Kohout 2020): flexion by 1 rad. The published volume error is
/// below 1 %.
namespace gracilis {

namespace {

/// Takes the scene through `degrees_per_frame` steps of flexion to 1 rad and back; the largest volume error of any
/// muscle.
void expect_published_volume(Scene scene, Real degrees_per_frame) {
  scene.method = find_preset("pbd-2020")->method;
  for (Muscle& muscle : scene.muscles) muscle.settings.clear();
  Eigen::MatrixXd keys = Eigen::MatrixXd::Zero(3, 1);
  keys(1, 0) = 1;
  scene.motion = motion_through({"hip_flexion_r"}, keys, radians(degrees_per_frame), usual_time_step);
  ASSERT_EQ(validate_method(scene).size(), 0u);
  const auto method = make_method(
      scene, [&](const DistanceFieldSettings& settings) { return cached_bone_fields(scene, settings, {}); });
  Frame frame;
  Real farthest = 0;
  for (const Pose& pose : pose_sequence(scene)) {
    method->advance(pose, usual_time_step);
    method->write(frame);
    for (std::size_t m = 0; m < scene.muscles.size(); ++m) {
      const TriangleMesh& rest = scene.muscles[m].surface;
      const Points& now = frame.muscles[m].points;
      farthest = std::max(farthest, (now - rest.vertices).colwise().norm().maxCoeff());
      EXPECT_NEAR(enclosed_volume(now, rest.faces) / enclosed_volume(rest.vertices, rest.faces), 1, 0.01)
          << scene.muscles[m].name;
    }
  }
  EXPECT_GT(farthest, 0.1) << "nothing moved";
}

}  // namespace

TEST(Pbd2020, keeps_volumes_of_the_builtin_hip_within_1_percent) { expect_published_volume(builtin_hip(), 1); }

TEST(Pbd2020, keeps_volumes_of_the_cadaver_hip_within_1_percent) {
  SKIP_WITHOUT_DATA();
  expect_published_volume(cadaver_scene("flexion"), 1);
}

}  // namespace gracilis
