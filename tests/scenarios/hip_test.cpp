#include <gracilis/core/state_hash.hpp>
#include <gracilis/io/scene/demo_scene.hpp>

#include "scenario_runs.hpp"

/// The built-in hip, which needs no file, and a coarse look at the real one; its whole motions are in
/// cadaver_hip_test.cpp.
namespace gracilis {

TEST(CadaverHipScenario, adductor_brevis_survives_flexion_in_steps_of_five_degrees) {
  SKIP_WITHOUT_DATA();
  const Scene scene = cadaver_scene("flexion", {"adductor_brevis_r"});
  const WholeRun run = run_whole(scene, 5);
  EXPECT_GT(run.frames, 35);
  expect_gates(scene, run);
}

TEST(BuiltinHip, crowded_it_resumes_to_the_same_bits) {
  for (const std::string contact : {"surface", "virtual-edges"}) {
    Scene scene = demo_scene("hip");
    scene.method.contact["muscle"] = contact;
    const std::vector<Pose> poses = pose_sequence(scene);
    const auto method = make_xpbd_method(scene, cached_bone_fields(scene)),
               resumed = make_xpbd_method(scene, cached_bone_fields(scene));
    const auto advance = [&](DeformationMethod& each, int number) {
      Frame frame;
      frame.number = number, frame.pose = poses[static_cast<std::size_t>(number)];
      each.advance(frame.pose, usual_time_step);
      each.write(frame);
      return frame;
    };
    const int last = 4 * resume_period(scene), end = last + resume_period(scene) + 2;
    ASSERT_LT(end, static_cast<int>(poses.size()));
    Frame before, at, expected, found;
    for (int number = 1; number <= last; ++number) before = at, at = advance(*method, number);
    for (int number = last + 1; number <= end; ++number) expected = advance(*method, number);
    resumed->restore({poses.begin(), poses.begin() + last + 1}, before, at);
    for (int number = last + 1; number <= end; ++number) found = advance(*resumed, number);
    for (std::size_t m = 0; m < scene.muscles.size(); ++m)
      EXPECT_EQ(hash_of(found.muscles[m].points), hash_of(expected.muscles[m].points)) << scene.muscles[m].name;
  }
}

}  // namespace gracilis
