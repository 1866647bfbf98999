#include <gracilis/io/scene/demo_scene.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/scene/motion.hpp>

#include <contact_check/gates.hpp>

#include "judged_run.hpp"

/// The built-in hip with virtual edges between its muscles.
namespace gracilis {

namespace {

/// Flexed by 30 degrees, three degrees per frame.
Scene flexed_hip(const Preset& preset) {
  Scene scene = demo_scene("hip");
  scene.distance_fields = preset.distance_fields;
  scene.method = preset.method;
  for (Muscle& muscle : scene.muscles) muscle.settings.clear();
  Eigen::MatrixXd keys = Eigen::MatrixXd::Zero(2, 1);
  keys(1, 0) = radians(30);
  scene.motion = motion_through({"hip_flexion_r"}, keys, radians(3), 1.0 / 60);
  return scene;
}

}  // namespace

TEST(VirtualEdgesOfTheBuiltinHip, the_published_setting_runs_with_them) {
  Real pushes = 0, coinciding = 0;
  const Scene scene = flexed_hip(*find_preset("thesis-2024"));
  ASSERT_EQ(scene.method.contact.at("muscle"), SettingValue("virtual-edges"));
  const WholeRun run = run_whole(scene, 1, [&](const FrameRecord& record) {
    if (record.frame.number == 0) return;
    for (const MuscleReport& report : record.report.muscles) {
      EXPECT_GT(metric(report.metrics, "virtual_edges"), 0);
      pushes += metric(report.metrics, "virtual_pushes"), coinciding += metric(report.metrics, "coinciding_edges");
    }
  });
  EXPECT_GT(run.frames, 10);
  EXPECT_GT(pushes, 100);
  EXPECT_GT(coinciding, 10);
}

}  // namespace gracilis
