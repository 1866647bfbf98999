#include <gracilis/transfer/carried_part.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Muscle muscle_between(const std::string& name, Index origin, Index insertion) {
  Muscle muscle;
  muscle.name = name;
  muscle.attachments = {{"origin", AttachmentEnd::origin, origin, {}},
                        {"insertion", AttachmentEnd::insertion, insertion, {}}};
  return muscle;
}

/// Pelvis, thigh, shank and foot, a bone each, one after the other; two muscles at the hip, one at the knee and one at
/// the ankle, on which a part of the triceps lies.
Scene leg() {
  Scene scene;
  scene.bodies = {"pelvis", "femur", "tibia", "foot", "soleus body"};
  for (Index body = 0; body < 4; ++body)
    scene.bones.push_back({scene.bodies[static_cast<std::size_t>(body)], body, {}});
  for (Index body = 1; body < 4; ++body) {
    Joint joint;
    joint.name = "joint of " + scene.bodies[static_cast<std::size_t>(body)];
    joint.parent_body = body - 1;
    joint.child_body = body;
    scene.joints.push_back(joint);
  }
  scene.muscles = {muscle_between("iliacus", 0, 1), muscle_between("gluteus", 0, 1), muscle_between("vastus", 1, 2),
                   muscle_between("soleus", 2, 3), muscle_between("gastrocnemius", 1, 4)};
  MuscleBody body;
  body.body = 4;
  body.muscle = 3;
  scene.muscle_bodies = {body};
  return scene;
}

/// The leg with the bones that the subject has.
Scene leg_with(const std::vector<char>& has_bones) {
  Scene scene = leg();
  std::erase_if(scene.bones, [&](const Bone& bone) { return !has_bones[static_cast<std::size_t>(bone.body)]; });
  return scene;
}

std::vector<std::string> names_of(const std::vector<Muscle>& muscles) {
  std::vector<std::string> names;
  for (const Muscle& muscle : muscles) names.push_back(muscle.name);
  return names;
}

}  // namespace

TEST(CarriedPart, all_bones_keep_all) {
  Scene scene = leg_with({1, 1, 1, 1, 0});
  std::vector<std::string> left_out;
  keep_connected_part(scene, {1, 1, 1, 1, 0}, left_out);
  EXPECT_TRUE(left_out.empty());
  EXPECT_EQ(scene.bones.size(), 4u);
  EXPECT_EQ(scene.joints.size(), 3u);
  EXPECT_EQ(scene.muscles.size(), 5u);
  EXPECT_EQ(scene.muscle_bodies.size(), 1u);
}

TEST(CarriedPart, without_a_bone_between_the_part_with_most_muscles_stays) {
  Scene scene = leg_with({1, 1, 0, 1, 0});
  std::vector<std::string> left_out;
  keep_connected_part(scene, {1, 1, 0, 1, 0}, left_out);
  EXPECT_THAT(names_of(scene.muscles), ElementsAre("iliacus", "gluteus"));
  ASSERT_EQ(scene.joints.size(), 1u);
  EXPECT_EQ(scene.joints[0].name, "joint of femur");
  ASSERT_EQ(scene.bones.size(), 2u) << "a foot that nothing moves against the thigh";
  EXPECT_TRUE(scene.muscle_bodies.empty());
  EXPECT_THAT(left_out, ElementsAre("joint joint of tibia: the subject has no bone of tibia",
                                    "joint joint of foot: the subject has no bone of tibia",
                                    "bone foot: no joint is left between foot and pelvis",
                                    "muscle vastus: the subject has no bone of tibia",
                                    "muscle soleus: the subject has no bone of tibia",
                                    "muscle gastrocnemius: it lies on soleus"));
}

TEST(CarriedPart, the_far_end_may_be_the_part_that_stays_and_carriers_are_numbered_anew) {
  Scene scene = leg_with({0, 1, 1, 1, 0});
  std::erase_if(scene.muscles, [](const Muscle& muscle) { return muscle.name == "iliacus"; });
  scene.muscle_bodies[0].muscle = 2;
  std::vector<std::string> left_out;
  keep_connected_part(scene, {0, 1, 1, 1, 0}, left_out);
  EXPECT_THAT(names_of(scene.muscles), ElementsAre("vastus", "soleus", "gastrocnemius"));
  EXPECT_EQ(scene.joints.size(), 2u);
  ASSERT_EQ(scene.muscle_bodies.size(), 1u);
  EXPECT_EQ(scene.muscle_bodies[0].muscle, 1);
}

TEST(CarriedPart, a_muscle_over_the_gap_goes_with_the_reason) {
  Scene scene = leg_with({1, 0, 1, 1, 0});
  scene.muscles.push_back(muscle_between("rectus", 0, 2));
  std::vector<std::string> left_out;
  keep_connected_part(scene, {1, 0, 1, 1, 0}, left_out);
  EXPECT_THAT(names_of(scene.muscles), ElementsAre("soleus"));
  EXPECT_THAT(left_out, testing::Contains("muscle rectus: no joint is left between pelvis and tibia"));
  EXPECT_THAT(left_out, testing::Contains(HasSubstr("bone pelvis: ")));
}

}  // namespace gracilis
