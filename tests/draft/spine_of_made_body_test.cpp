#include "made_spine.hpp"

#include <gracilis/anatomy/joints/joint_pose.hpp>

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

/// Joints of the spine, as fitted to vertebrae.
namespace gracilis {

namespace fs = std::filesystem;
using testing::HasSubstr;

namespace {

const Joint* joint_called(const Scene& scene, const std::string& name) {
  for (const Joint& joint : scene.joints)
    if (joint.name == name) return &joint;
  return nullptr;
}

std::string body_of_bone(const Scene& scene, const std::string& name) {
  for (const Bone& bone : scene.bones)
    if (bone.name == name) return scene.bodies[static_cast<std::size_t>(bone.body)];
  return "";
}

std::vector<std::string> joint_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const Joint& joint : scene.joints) names.push_back(joint.name);
  return names;
}

}  // namespace

TEST(SpineOfMadeBody, each_level_turns_about_the_middle_of_its_disc) {
  const TestFolder folder;
  made_spine::write_trunk(folder.path() / "trunk");
  const Scene scene = drafted_scene(folder.path() / "trunk").scene;
  EXPECT_EQ(joint_names(scene), (std::vector<std::string>{"L5_S1", "L4_L5", "L3_L4", "L2_L3", "L1_L2", "T12_L1"}));
  for (std::size_t level = 0; level < scene.joints.size(); ++level) {
    const Joint& joint = scene.joints[level];
    const Vec3 disc =
        made_spine::middle_of(static_cast<int>(level)) - Vec3(0, (made_spine::height + made_spine::gap) / 2, 0);
    EXPECT_LT((joint.frame.translation() - disc).norm(), 0.002) << joint.name;
    ASSERT_EQ(joint.axes.size(), 3u);
    EXPECT_EQ(joint.axes[0].coordinate, joint.name + "_FE");
    EXPECT_GT(joint.axes[0].axis.z(), std::cos(radians(2))) << "extension is positive, as in OpenSim's models";
    EXPECT_EQ(joint.axes[1].coordinate, joint.name + "_LB");
    EXPECT_GT(joint.axes[1].axis.x(), std::cos(radians(2)));
    EXPECT_EQ(joint.axes[2].coordinate, joint.name + "_AR");
    EXPECT_GT(joint.axes[2].axis.y(), std::cos(radians(2)));
  }
  EXPECT_EQ(body_of_bone(scene, "rib_12_r"), "torso");
  EXPECT_EQ(body_of_bone(scene, "vertebra_t12"), "torso");
  EXPECT_EQ(body_of_bone(scene, "vertebra_l3"), "lumbar3");
}

TEST(SpineOfMadeBody, vertebrae_on_a_line_tell_where_the_body_looks) {
  const TestFolder folder;
  // The files look along -z, as no axis of the column itself tells.
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(radians(90), Vec3::UnitY()).toRotationMatrix();
  const auto write_turned = [&](const std::string& name, TriangleMesh mesh) {
    for (auto point : mesh.vertices.colwise()) point = (turn * point).eval();
    made_spine::write(folder.path() / "b" / name, mesh);
  };
  for (int level = 0; level < 5; ++level)
    write_turned("L" + std::to_string(5 - level) + ".vtp",
                 made_spine::vertebra(made_spine::middle_of(level), made_spine::height, made_spine::radius));
  write_turned("multifidus_r.vtp", made_spine::back_muscle(made_spine::middle_of(0).y(), made_spine::middle_of(4).y()));
  const BodyFrame frame = draft_scene(folder.path() / "b").skeleton.frame;
  EXPECT_LT((frame.anterior - turn * Vec3::UnitX()).norm(), 1e-9);
  EXPECT_LT((frame.superior - Vec3::UnitY()).norm(), 1e-9);
}

TEST(SpineOfMadeBody, levels_bend_as_far_together_as_the_lumbar_spine_does) {
  const TestFolder folder;
  made_spine::write_trunk(folder.path() / "trunk");
  const Scene scene = drafted_scene(folder.path() / "trunk").scene;
  Real flexion = 0, extension = 0;
  std::vector<Real> pose = capture_coordinates(scene);
  for (std::size_t level = 0; level < scene.joints.size(); ++level) {
    const JointAxis& axis = scene.joints[level].axes[0];
    flexion -= axis.range_min, extension += axis.range_max;
    pose[3 * level] = axis.range_min;
  }
  EXPECT_NEAR(degrees(flexion + extension), 86, 0.5) << "White and Panjabi 1990, T12 to S1";
  EXPECT_NEAR(flexion / (flexion + extension), 0.75, 0.01);
  ASSERT_EQ(scene.motion.coordinates.size(), 6u) << "the default motion bends all levels";
  const Real shown = -degrees(scene.motion.values.row(scene.motion.values.rows() - 1).sum());
  EXPECT_GT(shown, 30);
  EXPECT_LT(shown, degrees(flexion));
  // The chest comes forward and down.
  const RigidTransform chest = pose_at(scene, pose).bodies[static_cast<std::size_t>(scene.joints.back().child_body)];
  const Vec3 before = made_spine::middle_of(6);
  EXPECT_GT((chest * before - before).x(), 0.05);
  EXPECT_LT((chest * before - before).y(), 0);
}

TEST(SpineOfMadeBody, a_vertebra_that_leans_turns_about_axes_that_lean_with_it) {
  const TestFolder folder;
  const Real lean = radians(30);
  const Vec3 along = Eigen::AngleAxisd(-lean, Vec3::UnitZ()) * Vec3::UnitY();
  const Real step = made_spine::height + made_spine::gap;
  const Vec3 low = made_spine::middle_of(-1);
  const auto placed = [&](int level) {
    return made_spine::vertebra(low + (level + 1) * step * along, made_spine::height, made_spine::radius, -lean);
  };
  made_spine::write(folder.path() / "b" / "sacrum.vtp", placed(-1));
  for (int level = 0; level < 3; ++level)
    made_spine::write(folder.path() / "b" / ("lumbar_" + std::to_string(5 - level) + ".vtp"), placed(level));
  made_spine::write(folder.path() / "b" / "hip_bone_r.vtp",
                    made_spine::rod({{low + Vec3(0, 0, 0.09), 0.03}, {low + Vec3(0.02, -0.1, 0.07), 0.03}}));
  const Vec3 back = low - 0.056 * along.cross(Vec3::UnitZ()) + Vec3(0, 0, 0.016);
  made_spine::write(
      folder.path() / "b" / "multifidus_r.vtp",
      made_spine::rod({{back, 0.006}, {back + 1.5 * step * along, 0.01}, {back + 3 * step * along, 0.006}}));
  const SceneDraft draft = draft_scene(folder.path() / "b");
  ASSERT_EQ(draft.skeleton.joints.size(), 3u);
  for (const DraftJoint& joint : draft.skeleton.joints) {
    EXPECT_GT(joint.axes[2].direction.dot(along), std::cos(radians(3))) << joint.name;
    EXPECT_GT(joint.axes[0].direction.z(), std::cos(radians(3))) << joint.name;
    EXPECT_GE(joint.guess.certainty, 0.8) << joint.name;
  }
}

TEST(SpineOfMadeBody, a_leg_with_vertebrae_but_no_muscle_that_bends_them_keeps_them_with_its_pelvis) {
  const TestFolder folder;
  made_spine::write_trunk(folder.path() / "trunk");
  fs::remove(folder.path() / "trunk" / "erector_spinae_r.vtp");
  made_spine::write(
      folder.path() / "trunk" / "femur_r.vtp",
      made_spine::rod({{Vec3(0, 0.95, 0.08), 0.024}, {Vec3(0, 0.9, 0.09), 0.015}, {Vec3(0, 0.5, 0.08), 0.018}}));
  made_spine::write(folder.path() / "trunk" / "psoas_major_r.vtp",
                    made_spine::rod({{Vec3(0, 1.15, 0.035), 0.008}, {Vec3(0.02, 0.87, 0.09), 0.008}}));
  const SceneDraft draft = draft_scene(folder.path() / "trunk");
  for (const DraftJoint& joint : draft.skeleton.joints) EXPECT_EQ(joint.name, "hip_r");
  EXPECT_THAT(draft.skeleton.guesses,
              testing::Contains(testing::Field(&Guess::how, HasSubstr("none of the muscles that bend the spine"))));
}

TEST(SpineOfMadeBody, vertebrae_of_one_surface_move_as_one_and_that_is_told) {
  const TestFolder folder;
  made_spine::write_trunk(folder.path() / "trunk");
  TriangleMesh all = made_spine::vertebra(made_spine::middle_of(0), made_spine::height, made_spine::radius);
  for (int level = 0; level < 5; ++level) {
    fs::remove(folder.path() / "trunk" / ("L" + std::to_string(5 - level) + ".vtp"));
    if (level > 0)
      all =
          shapes::both(all, made_spine::vertebra(made_spine::middle_of(level), made_spine::height, made_spine::radius));
  }
  made_spine::write(folder.path() / "trunk" / "lumbar_spine.vtp", all);
  const SceneDraft draft = draft_scene(folder.path() / "trunk");
  ASSERT_EQ(draft.skeleton.joints.size(), 2u);
  EXPECT_EQ(draft.skeleton.joints[0].name, "L5_S1");
  EXPECT_EQ(draft.skeleton.joints[1].name, "T12_L1");
  EXPECT_THAT(draft.skeleton.guesses,
              testing::Contains(testing::AllOf(testing::Field(&Guess::subject, "lumbar_spine"),
                                               testing::Field(&Guess::how, HasSubstr("its vertebrae move as one")))));
}

TEST(SpineOfMadeBody, a_missing_vertebra_leaves_what_is_above_it_with_what_is_below) {
  const TestFolder folder;
  made_spine::write_trunk(folder.path() / "trunk");
  fs::remove(folder.path() / "trunk" / "L3.vtp");
  const SceneDraft draft = draft_scene(folder.path() / "trunk");
  for (const DraftJoint& joint : draft.skeleton.joints) {
    EXPECT_NE(joint.name, "L2_L3");
    EXPECT_NE(joint.child, "lumbar2");
  }
  EXPECT_EQ(draft.skeleton.joints.size(), 4u);
  EXPECT_THAT(draft.skeleton.guesses, testing::Contains(testing::Field(&Guess::how, HasSubstr("'L2_L3'"))));
}

TEST(SpineOfMadeBody, a_muscle_that_lies_along_vertebrae_still_ends_on_the_sacrum) {
  const TestFolder folder;
  made_spine::write_trunk(folder.path() / "trunk");
  // Its lower end is lifted off the bone by a tendon's thickness, farther than the belly is off the vertebrae.
  const Real x = -0.056, z = 0.016, low = made_spine::middle_of(-1).y(), high = made_spine::middle_of(5).y();
  made_spine::write(folder.path() / "trunk" / "erector_spinae_r.vtp",
                    made_spine::rod({{Vec3(x - 0.004, low - 0.008, z - 0.002), 0.005},
                                     {Vec3(x, (low + high) / 2, z), 0.01},
                                     {Vec3(x, high, z), 0.006}}));
  const SceneDraft draft = draft_scene(folder.path() / "trunk");
  ASSERT_EQ(draft.muscles.size(), 1u);
  std::vector<std::string> origins;
  for (const DraftAttachment& each : draft.muscles[0].attachments)
    if (each.end == AttachmentEnd::origin) origins.push_back(each.body);
  EXPECT_THAT(origins, testing::Contains("pelvis"));
}

TEST(SpineOfMadeBody, a_muscle_from_vertebra_to_vertebra_begins_below_and_ends_above) {
  const TestFolder folder;
  made_spine::write_trunk(folder.path() / "trunk");
  fs::remove(folder.path() / "trunk" / "erector_spinae_r.vtp");
  made_spine::write(folder.path() / "trunk" / "multifidus_r.vtp",
                    made_spine::back_muscle(made_spine::middle_of(1).y(), made_spine::middle_of(4).y()));
  const SceneDraft draft = draft_scene(folder.path() / "trunk");
  ASSERT_EQ(draft.muscles.size(), 1u);
  for (const DraftAttachment& each : draft.muscles[0].attachments) {
    const int depth = draft.skeleton.depth(each.body);
    if (each.end == AttachmentEnd::origin)
      EXPECT_LE(depth, 4) << each.body;
    else
      EXPECT_GE(depth, 3) << each.body;
  }
}

TEST(SpineOfMadeBody, a_neck_moves_its_head_between_atlas_and_axis_and_on_both_joints_of_the_atlas) {
  const TestFolder folder;
  const fs::path neck = folder.path() / "neck";
  const auto at = [](int level) { return Vec3(0, 1.5 + 0.018 * level, 0); };
  const auto write_level = [&](const std::string& name, int level) {
    made_spine::write(neck / (name + ".vtp"), made_spine::vertebra(at(level), 0.013, 0.01));
  };
  write_level("T1", 0);
  for (int n = 7; n >= 3; --n) write_level("C" + std::to_string(n), 8 - n);
  write_level("Axis", 6);
  // The atlas has no body: two masses, between which the dens of the axis would stand, joined by arches.
  const Vec3 atlas = at(7) + Vec3(0, 0.003, 0);
  made_spine::write(neck / "Atlas.vtp", made_spine::rod({{atlas + Vec3(0, 0, -0.018), 0.007},
                                                         {atlas + Vec3(-0.03, 0, 0), 0.004},
                                                         {atlas + Vec3(0, 0, 0.018), 0.007},
                                                         {atlas + Vec3(0.014, 0, 0), 0.004},
                                                         {atlas + Vec3(0, 0, -0.018), 0.007}}));
  const auto condyle = [&](Real z) {
    return thick_curve({{atlas + Vec3(0, 0.019, z), 0.008}, {atlas + Vec3(0, 0.04, z), 0.01}});
  };
  made_spine::write(neck / "Skull.vtp",
                    made_spine::surface_of(smooth_union(
                        {condyle(-0.018), condyle(0.018), ball(atlas + Vec3(0.01, 0.1, 0), 0.07)}, 0.004)));
  made_spine::write(neck / "sternum.vtp", made_spine::rod({{Vec3(0.07, 1.48, 0), 0.01}, {Vec3(0.09, 1.34, 0), 0.01}}));
  made_spine::write(neck / "sternocleidomastoid_r.vtp", made_spine::rod({{Vec3(0.07, 1.49, 0.012), 0.005},
                                                                         {Vec3(0.05, 1.57, 0.04), 0.008},
                                                                         {atlas + Vec3(0.01, 0.05, 0.058), 0.006}}));
  const Scene scene = drafted_scene(neck).scene;
  EXPECT_EQ(joint_names(scene),
            (std::vector<std::string>{"C7_T1", "C6_C7", "C5_C6", "C4_C5", "C3_C4", "C2_C3", "C1_C2", "C0_C1"}));
  const Joint *turning = joint_called(scene, "C1_C2"), *nodding = joint_called(scene, "C0_C1");
  ASSERT_TRUE(turning && nodding);
  EXPECT_NEAR(degrees(turning->axes[2].range_max), 40, 1e-6) << "half of the head's turning is there";
  EXPECT_LT(std::abs(nodding->frame.translation().z()), 0.002) << "between both condyles";
  EXPECT_EQ(body_of_bone(scene, "vertebra_c1"), "cerv1");
  EXPECT_EQ(body_of_bone(scene, "sternum"), "torso");
}

}  // namespace gracilis
