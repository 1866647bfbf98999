#pragma once

#include "scenario_runs.hpp"

/// The preset `fast` against the default on the four muscles of the published study (61,354 triangles).
namespace gracilis {

inline const std::vector<std::string> study = {"gluteus_maximus_r", "gluteus_medius_r", "iliacus_r",
                                               "adductor_brevis_r"};

/// All muscles' shapes in every 15th frame of a motion, one after the other; every gate is held on the way.
inline std::vector<Points> shapes_of(const std::string& motion, const std::vector<std::string>& set) {
  const Scene scene = cadaver_scene(motion, study, set);
  std::vector<Points> shapes;
  const WholeRun run = run_whole(scene, 1, [&](const FrameRecord& record) {
    if (record.frame.number % 15 != 0) return;
    for (const MuscleShape& shape : record.frame.muscles) shapes.push_back(shape.points);
  });
  expect_gates(scene, run);
  return shapes;
}

class FastPreset : public ::testing::TestWithParam<std::string> {};

TEST_P(FastPreset, stays_within_a_millimetre_of_the_default) {
  SKIP_WITHOUT_DATA();
  const std::vector<Points> whole = shapes_of(GetParam(), {}), fast = shapes_of(GetParam(), {"preset=fast"});
  ASSERT_EQ(fast.size(), whole.size());
  ASSERT_GE(fast.size(), 3 * study.size());
  Real farthest = 0;
  for (std::size_t i = 0; i < fast.size(); ++i) {
    const Real mean = (fast[i] - whole[i]).colwise().norm().mean();
    EXPECT_LT(mean, 0.001) << study[i % study.size()] << ", frame " << 15 * (i / study.size());
    farthest = std::max(farthest, mean);
  }
  EXPECT_GT(farthest, 1e-6) << "nothing was made coarser";
}

}  // namespace gracilis
