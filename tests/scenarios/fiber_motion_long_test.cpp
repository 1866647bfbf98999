#include <gracilis/scene/motion.hpp>
#include <gracilis/simulate/moment_arms.hpp>

#include "scenarios/fiber_runs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gracilis {

TEST(FiberMotion, through_flexion_lengthens_extensors_and_shortens_flexors) {
  SKIP_WITHOUT_DATA();
  Scene scene = cadaver_scene("flexion");
  scene.sequence.return_to_capture = false;
  scene.motion =
      motion_through({"hip_flexion_r", "hip_adduction_r", "hip_rotation_r"},
                     (Eigen::MatrixXd(3, 3) << 0, 0, 0, radians(90), 0, 0, 0, 0, 0).finished(), radians(1), 1.0 / 60);
  const FiberRun run = run_with_fibers(scene);
  const std::size_t back = run.frames.size() - 1, last = back - 90, first = last - 90;
  ASSERT_NEAR(run.flexion[first], 0, 1e-9);
  ASSERT_NEAR(run.flexion[last], radians(90), 1e-9);
  ASSERT_NEAR(run.flexion[back], 0, 1e-9);

  const std::vector<Real> iliacus = run.means(muscle_of(scene, "iliacus_r"), first, last);
  EXPECT_TRUE(std::is_sorted(iliacus.rbegin(), iliacus.rend())) << "monotonically shorter";
  EXPECT_GT(iliacus.front() - iliacus.back(), 0.035);
  EXPECT_LT(iliacus.front() - iliacus.back(), 0.075);

  const std::size_t maximus = muscle_of(scene, "gluteus_maximus_r");
  for (std::size_t f = 0; f < 100; ++f) {
    EXPECT_GT(run.frames[last][maximus].lengths[f], run.frames[first][maximus].lengths[f]) << "fiber " << f;
    EXPECT_NEAR(run.frames[back][maximus].lengths[f], run.frames[first][maximus].lengths[f], 0.001) << "fiber " << f;
  }

  const std::vector<Real> brevis = run.means(muscle_of(scene, "adductor_brevis_r"), first, last);
  const auto shortest = std::min_element(brevis.begin(), brevis.end()) - brevis.begin();
  EXPECT_GE(shortest, 15);
  EXPECT_LE(shortest, 75);

  const std::vector<Real> psoas = run.means(muscle_of(scene, "psoas_major_r"), first, last);
  EXPECT_LT(psoas.back(), psoas.front());
}

TEST(FiberMotion, moment_arms_about_flexion_have_the_signs_of_anatomy_and_no_jumps) {
  SKIP_WITHOUT_DATA();
  Scene scene = cadaver_scene("flexion");
  scene.sequence.return_to_capture = false;
  scene.motion =
      motion_through({"hip_flexion_r", "hip_adduction_r", "hip_rotation_r"},
                     (Eigen::MatrixXd(2, 3) << radians(-10), 0, 0, radians(60), 0, 0).finished(), radians(2), 1.0 / 60);
  const FiberRun run = run_with_fibers(scene);
  constexpr std::size_t rows = 36;
  const std::size_t first = run.frames.size() - rows;
  const Eigen::VectorXd angles = Eigen::Map<const Eigen::VectorXd>(run.flexion.data() + first, rows);
  for (const auto& [name, sign] : {std::pair{"gluteus_maximus_r", -1}, {"iliacus_r", 1}, {"psoas_major_r", 1}}) {
    const std::vector<Real> lengths = run.means(muscle_of(scene, name), first, run.frames.size() - 1);
    const Eigen::MatrixXd arms = moment_arms(angles, Eigen::Map<const Eigen::VectorXd>(lengths.data(), rows));
    EXPECT_GT((sign * arms).minCoeff(), 0) << name;
    EXPECT_LT(largest_step_per_degree(angles, arms.col(0)), 0.001) << name;
  }
}

}  // namespace gracilis
