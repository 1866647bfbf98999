#include <gracilis/anatomy/joint_control.hpp>
#include <gracilis/scene/motion.hpp>

#include "scenarios/fiber_runs.hpp"

#include <gtest/gtest.h>

namespace gracilis {
namespace {

/// One muscle of the cadaver hip on its way from the capture pose to flexion, adduction and rotation `to` (degrees), as
/// active as this all the way.
FiberRun active_run(const std::string& muscle, const Vec3& to, Real activation, int fibers = 100) {
  Scene scene = cadaver_scene("flexion", {muscle});
  scene.sequence.return_to_capture = false;
  Eigen::MatrixXd keys = Eigen::MatrixXd::Zero(2, 3);
  keys.row(1) = to.transpose() * radians(1);
  scene.motion = motion_through({"hip_flexion_r", "hip_adduction_r", "hip_rotation_r"}, keys, radians(1), 1.0 / 60);
  scene.activation.signals = {{muscle, {0}, {activation}}};
  scene.muscles[0].fibers.count = fibers;
  return run_with_fibers(scene);
}

void expect_volume(const FiberRun& run) {
  for (const auto& frame : run.measures) EXPECT_NEAR(frame[0].volume_ratio, 1, 0.005);
}

Real rms_distance(const FiberRun& one, const FiberRun& other) {
  const Points difference = one.end[0].points - other.end[0].points;
  return std::sqrt(difference.colwise().squaredNorm().mean());
}

}  // namespace

TEST(ActiveMuscle, gluteus_medius_in_abduction_is_thicker_than_a_relaxed_one) {
  SKIP_WITHOUT_DATA();
  const FiberRun relaxed = active_run("gluteus_medius_r", {0, -35, 0}, 0),
                 active = active_run("gluteus_medius_r", {0, -35, 0}, 0.3);
  EXPECT_GE(active.frames.back()[0].cross_section, 1.05 * relaxed.frames.back()[0].cross_section);
  expect_volume(relaxed);
  expect_volume(active);
}

TEST(ActiveMuscle, iliacus_in_flexion_has_straighter_and_shorter_fibers) {
  SKIP_WITHOUT_DATA();
  const FiberRun relaxed = active_run("iliacus_r", {45, 0, 0}, 0), active = active_run("iliacus_r", {45, 0, 0}, 0.3);
  const MuscleFibers &slack = relaxed.frames.back()[0], &taut = active.frames.back()[0];
  EXPECT_LT(taut.mean_length, slack.mean_length - 0.0002);
  // Over the distance of their ends.
  const auto straightness = [](const MuscleFibers& fibers) {
    Real sum = 0;
    for (Index i = 0; i < fibers.lines.count(); ++i) {
      const Points line = fibers.lines.line(i);
      sum += fibers.lengths[static_cast<std::size_t>(i)] / (line.rightCols(1) - line.leftCols(1)).norm();
    }
    return sum / fibers.lines.count();
  };
  EXPECT_LT(straightness(taut), straightness(slack) - 0.002);
  expect_volume(relaxed);
  expect_volume(active);
}

TEST(ActiveMuscle, keeps_its_shape_whether_there_are_sixteen_fibers_or_a_hundred) {
  SKIP_WITHOUT_DATA();
  for (const char* muscle : {"psoas_major_r", "gluteus_medius_r"}) {
    const Vec3 to = Vec3(45, 0, 0);
    const FiberRun relaxed = active_run(muscle, to, 0), few = active_run(muscle, to, 0.3, 16),
                   many = active_run(muscle, to, 0.3);
    EXPECT_LT(rms_distance(few, many), 0.001) << muscle;
    EXPECT_LT(rms_distance(few, many), 0.25 * rms_distance(relaxed, many)) << muscle;
    expect_volume(few);
    expect_volume(many);
  }
}

TEST(JointControl, half_of_the_samples_of_a_gait_interpolate_the_others_within_a_tenth) {
  SKIP_WITHOUT_DATA();
  const Scene scene = cadaver_scene("gait");
  ASSERT_EQ(scene.activation.units.size(), 1u);
  const JointControlUnit& unit = scene.activation.units[0];
  ASSERT_EQ(unit.muscles.size(), 5u);
  ASSERT_GT(unit.angles.rows(), 100);
  const Eigen::VectorXd errors = leave_out_error(unit);
  for (Index i = 0; i < errors.size(); ++i) EXPECT_LE(errors[i], 0.1) << unit.muscles[static_cast<std::size_t>(i)];
}

}  // namespace gracilis
