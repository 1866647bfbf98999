#include "judged_run.hpp"

namespace gracilis {
namespace {

std::filesystem::path leg_folder() {
  const std::filesystem::path folder = data_folder();
  return folder.empty() ? folder : folder / "leg";
}

/// The adductors of a leg whose surfaces overlap at rest by up to 4.6 mm, in large triangles beside thin sheets.
Scene adductors(const std::vector<std::string>& set) {
  SceneOptions options;
  options.data = leg_folder();
  options.only = {"adductor_brevis_r",  "adductor_longus_r", "adductor_magnus_r",
                  "adductor_minimus_r", "pectineus_r",       "gracilis_r"};
  options.set = set;
  return read_scene(leg_folder() / "leg.toml", options).scene;
}

Index face_pairs(const contact_check::FrameVerdict& verdict) {
  Index sum = 0;
  for (const contact_check::PairVerdict& pair : verdict.pairs) sum += pair.face_pairs;
  return sum;
}

}  // namespace

TEST(Leg, no_muscle_misses_a_gate_while_hip_and_knee_bend) {
  if (leg_folder().empty() || !std::filesystem::is_directory(leg_folder()))
    GTEST_SKIP() << "the leg's data are not here";
  SceneOptions options;
  options.data = leg_folder();
  options.set = {"motion.step_deg=4"};
  expect_gates_kept(read_scene(leg_folder() / "leg.toml", options).scene);
}

TEST(Leg, muscles_that_overlap_at_rest_stay_whole_and_come_apart) {
  if (leg_folder().empty() || !std::filesystem::is_directory(leg_folder()))
    GTEST_SKIP() << "the leg's data are not here";
  Scene scene = adductors({"motion.step_deg=0.5"});
  std::vector<Pose> poses = pose_sequence(scene);
  poses.resize(31);
  const contact_check::Judge judge = judge_of(scene);
  const auto method = make_xpbd_method(scene, cached_bone_fields(scene));
  const std::atomic<bool> never = false;
  std::vector<Index> pairs;
  const auto look = [&](const FrameRecord& record) {
    for (std::size_t m = 0; m < scene.muscles.size(); ++m) {
      ASSERT_TRUE(record.measures[m].finite) << scene.muscles[m].name << ", frame " << record.frame.number;
      EXPECT_LE(record.measures[m].edge_ratio_max_free, 3)
          << scene.muscles[m].name << ", frame " << record.frame.number;
      EXPECT_NEAR(record.measures[m].volume_ratio, 1, 0.005) << scene.muscles[m].name;
    }
    if (record.frame.number % 10 != 0) return;
    std::vector<Points> muscles, bones;
    for (const MuscleShape& muscle : record.frame.muscles) muscles.push_back(muscle.points);
    for (const Bone& bone : scene.bones)
      bones.push_back(record.frame.pose.bodies[static_cast<std::size_t>(bone.body)] * bone.surface.vertices);
    pairs.push_back(face_pairs(judge.judge(record.frame.number, muscles, bones)));
  };
  EXPECT_EQ(run_scene(scene, poses, *method, nullptr, never, look), RunEnd::complete);
  ASSERT_EQ(pairs.size(), 4u);
  for (std::size_t i = 1; i < pairs.size(); ++i) EXPECT_LE(pairs[i], pairs.front()) << "frame " << 10 * i;
  EXPECT_LE(2 * pairs.back(), pairs.front()) << "halved within 30 frames";
}

}  // namespace gracilis
