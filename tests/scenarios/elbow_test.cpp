#include "scenario_runs.hpp"

#include <gracilis/anatomy/fibers/inner_fibers.hpp>

#include <gtest/gtest.h>

namespace gracilis {
namespace {

std::filesystem::path elbow_folder() {
  const std::filesystem::path folder = data_folder();
  return folder.empty() ? folder : folder / "elbow";
}

/// How far the middle third of a muscle moves in the frame of a body, on average, m.
Vec3 middle_moves(const Muscle& muscle, const Points& now, const RigidTransform& body) {
  const Eigen::VectorXd along = origin_to_insertion(muscle);
  const Points& rest = muscle.surface.vertices;
  Vec3 sum = Vec3::Zero();
  int count = 0;
  for (Index v = 0; v < rest.cols(); ++v) {
    if (along[v] < 1.0 / 3 || along[v] > 2.0 / 3) continue;
    sum += body.inverse() * Vec3(now.col(v)) - rest.col(v);
    ++count;
  }
  return sum / std::max(count, 1);
}

Index body_named(const Scene& scene, const std::string& name) {
  return static_cast<Index>(std::find(scene.bodies.begin(), scene.bodies.end(), name) - scene.bodies.begin());
}

/// Runs a motion and holds every muscle's middle third, in every frame, against where the humerus carries it.
WholeRun expect_bellies_beside(const Scene& scene, Index humerus, const Vec3& along_humerus, int stride) {
  return run_whole(scene, stride, [&](const FrameRecord& record) {
    for (std::size_t m = 0; m < scene.muscles.size(); ++m) {
      Vec3 moved = middle_moves(scene.muscles[m], record.frame.muscles[m].points,
                                record.frame.pose.bodies[static_cast<std::size_t>(humerus)]);
      moved -= along_humerus * along_humerus.dot(moved);
      EXPECT_LE(moved.norm(), 0.015) << scene.muscles[m].name << ", frame " << record.frame.number;
    }
  });
}

}  // namespace

TEST(Elbow, bellies_of_a_scanned_elbow_stay_with_the_humerus) {
  if (elbow_folder().empty() || !std::filesystem::is_directory(elbow_folder()))
    GTEST_SKIP() << "the elbow's data are not here";
  SceneOptions options;
  options.data = elbow_folder();
  const Scene scene = read_scene(elbow_folder() / "elbow.toml", options).scene;
  const WholeRun run = expect_bellies_beside(scene, body_named(scene, "humerus"), Vec3::UnitY(), 2);
  for (std::size_t m = 0; m < run.muscles.size(); ++m) {
    EXPECT_LE(run.muscles[m].belly_off_place, 0.018) << scene.muscles[m].name;
    EXPECT_EQ(run.muscles[m].wrong_side, 0) << scene.muscles[m].name;
    EXPECT_LE(run.muscles[m].slack, 0.15) << scene.muscles[m].name;
    EXPECT_LE(run.muscles[m].volume_error, 0.005) << scene.muscles[m].name;
    EXPECT_LE(run.muscles[m].free_edge_ratio, 3) << scene.muscles[m].name;
  }
}

}  // namespace gracilis
