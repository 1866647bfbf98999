#include <gracilis/anatomy/joint_pose.hpp>
#include <gracilis/scene/motion.hpp>
#include <gracilis/simulate/fiber_tracker.hpp>
#include <gracilis/simulate/moment_arms.hpp>

#include "scenarios/scenario_runs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gracilis {
namespace {

/// Flexion and the fibers of all muscles, frame by frame.
struct FiberRun {
  std::vector<Real> flexion;                      ///< rad
  std::vector<std::vector<MuscleFibers>> frames;  ///< frames × muscles

  std::vector<Real> means(std::size_t muscle, std::size_t first, std::size_t last) const {
    std::vector<Real> values;
    for (std::size_t i = first; i <= last; ++i) values.push_back(frames[i][muscle].mean_length);
    return values;
  }
};

FiberRun run_with_fibers(const Scene& scene) {
  std::vector<DistanceField> fields;
  for (const Bone& bone : scene.bones)
    fields.push_back(cached_bone_field(bone, scene.distance_fields, default_cache_folder()));
  const auto method = make_xpbd_method(scene, std::move(fields));
  const FiberTracker tracker(scene);
  const std::vector<std::string> names = coordinate_names(scene);
  const auto flexion = static_cast<std::size_t>(std::find(names.begin(), names.end(), "hip_flexion_r") - names.begin());
  FiberRun run;
  const std::atomic<bool> never = false;
  run_scene(
      scene, pose_sequence(scene), *method, nullptr, never,
      [&](const FrameRecord& record) {
        run.flexion.push_back(record.frame.pose.coordinates[flexion]);
        run.frames.push_back(record.fibers);
      },
      &tracker);
  return run;
}

std::size_t muscle_of(const Scene& scene, const std::string& name) {
  for (std::size_t i = 0; i < scene.muscles.size(); ++i)
    if (scene.muscles[i].name == name) return i;
  ADD_FAILURE() << name;
  return 0;
}

}  // namespace

TEST(FiberMotion, through_flexion_lengthens_extensors_and_shortens_flexors) {
  SKIP_WITHOUT_DATA();
  Scene scene = cadaver_scene("flexion");
  scene.sequence.return_to_capture = false;
  scene.motion = motion_through({"hip_flexion_r", "hip_adduction_r", "hip_rotation_r"},
                                (Eigen::MatrixXd(2, 3) << 0, 0, 0, radians(90), 0, 0).finished(), radians(1), 1.0 / 60);
  const FiberRun run = run_with_fibers(scene);
  const std::size_t last = run.frames.size() - 1, first = last - 90;
  ASSERT_NEAR(run.flexion[first], 0, 1e-9);
  ASSERT_NEAR(run.flexion[last], radians(90), 1e-9);

  const std::vector<Real> iliacus = run.means(muscle_of(scene, "iliacus_r"), first, last);
  EXPECT_TRUE(std::is_sorted(iliacus.rbegin(), iliacus.rend())) << "monotonically shorter";
  EXPECT_GT(iliacus.front() - iliacus.back(), 0.035);
  EXPECT_LT(iliacus.front() - iliacus.back(), 0.075);

  const std::size_t maximus = muscle_of(scene, "gluteus_maximus_r");
  for (std::size_t f = 0; f < 100; ++f)
    EXPECT_GT(run.frames[last][maximus].lengths[f], run.frames[first][maximus].lengths[f]) << "fiber " << f;

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
