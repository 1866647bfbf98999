#include <gracilis/simulate/moment_arms.hpp>

#include "scenarios/active_runs.hpp"
#include "scenarios/judged_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace gracilis {

TEST(ActiveMuscle, iliacus_flexed_to_ninety_degrees_and_back_shortens_steadily_and_returns) {
  SKIP_WITHOUT_DATA();
  Scene scene = active_scene("iliacus_r", {90, 0, 0}, 0.3);
  Eigen::MatrixXd keys = Eigen::MatrixXd::Zero(3, 3);
  keys(1, 0) = radians(90);
  scene.motion = motion_through({"hip_flexion_r", "hip_adduction_r", "hip_rotation_r"}, keys, radians(1), 1.0 / 60);
  scene.sequence.settle_frames = 30;
  const JudgedRun judged = run_judged(scene, 3);
  for (const contact_check::Measure measure : {contact_check::self_pairs, contact_check::folded_share})
    EXPECT_FALSE(judged.worst[measure].missed)
        << contact_check::measure_names()[measure] << ": " << judged.worst[measure].value << " in frame "
        << judged.worst[measure].frame;
  const FiberRun run = run_with_fibers(scene);
  const std::size_t back = run.frames.size() - 1, last = back - 90, first = last - 90;
  ASSERT_NEAR(run.flexion[last], radians(90), 1e-9);
  const std::vector<Real> lengths = run.means(0, first, last);
  EXPECT_TRUE(std::is_sorted(lengths.rbegin(), lengths.rend())) << "monotonically shorter";
  EXPECT_GT(lengths.front() - lengths.back(), 0.035);
  EXPECT_LT(lengths.front() - lengths.back(), 0.075);
  EXPECT_NEAR(run.frames[back][0].mean_length, run.frames[first][0].mean_length, 0.001);
  expect_volume(run);
}

TEST(ActiveMuscle, has_the_same_mean_length_with_twice_the_fibers_or_twice_their_points) {
  SKIP_WITHOUT_DATA();
  for (const char* muscle : {"psoas_major_r", "iliacus_r"}) {
    const auto length = [&](int fibers, int segments) {
      return active_run(muscle, {45, 0, 0}, 0.3, fibers, segments).frames.back()[0].mean_length;
    };
    const Real usual = length(100, 15);
    EXPECT_NEAR(length(200, 15) / usual, 1, 0.01) << muscle;
    EXPECT_NEAR(length(100, 30) / usual, 1, 0.01) << muscle;
  }
}

TEST(ActiveMuscle, has_moment_arms_about_flexion_with_the_signs_of_anatomy_and_no_jumps) {
  SKIP_WITHOUT_DATA();
  for (const auto& [name, sign] : {std::pair{"gluteus_maximus_r", -1}, {"iliacus_r", 1}, {"psoas_major_r", 1}}) {
    Scene scene = active_scene(name, {60, 0, 0}, 0.3);
    Eigen::MatrixXd keys = Eigen::MatrixXd::Zero(2, 3);
    keys(0, 0) = radians(-10), keys(1, 0) = radians(60);
    scene.motion = motion_through({"hip_flexion_r", "hip_adduction_r", "hip_rotation_r"}, keys, radians(5), 1.0 / 60);
    scene.sequence.settle_frames = 30;
    const FiberRun run = run_with_fibers(scene);
    constexpr std::size_t rows = 15;
    const std::size_t first = run.frames.size() - rows;
    ASSERT_NEAR(run.flexion[first], radians(-10), 1e-9);
    const Eigen::VectorXd angles = Eigen::Map<const Eigen::VectorXd>(run.flexion.data() + first, rows);
    const std::vector<Real> lengths = run.means(0, first, run.frames.size() - 1);
    const Eigen::MatrixXd arms = moment_arms(angles, Eigen::Map<const Eigen::VectorXd>(lengths.data(), rows));
    EXPECT_GT((sign * arms).minCoeff(), 0) << name;
    EXPECT_LT(largest_step_per_degree(angles, arms.col(0)), 0.001) << name;
  }
}

}  // namespace gracilis
