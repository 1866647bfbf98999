#include "made_body.hpp"

#include <gracilis/geometry/measures.hpp>

#include <gmock/gmock.h>

/// Joints of folders, as fitted and by landmarks.
namespace gracilis {

TEST(JointsOfMadeBody, the_radius_turns_about_the_ulna_where_a_supinator_is_there) {
  const TestFolder folder;
  const std::map<std::string, std::string> names = {{"humerus_r", "humerus_r.vtp"},
                                                    {"ulna_r", "ulna_r.vtp"},
                                                    {"radius_r", "radius_r.vtp"},
                                                    {"brachialis_r", "brachialis_r.vtp"},
                                                    {"brachioradialis_r", "supinator_r.vtp"}};
  write_body(folder.path() / "arm", elbow(), names);
  const LoadedScene drafted = drafted_scene(folder.path() / "arm");
  const Joint &found = joint_named(drafted.scene, "radioulnar_r"), &made = joint_named(elbow(), "radioulnar_r");
  EXPECT_LT((found.frame.translation() - made.frame.translation()).cross(direction(made, 0)).norm(), 0.006);
  EXPECT_GT(direction(found, 0).dot(direction(made, 0)), std::cos(radians(5)));
  EXPECT_EQ(found.axes[0].coordinate, "pro_sup_r");
  EXPECT_NEAR(found.axes[0].capture_value, made.axes[0].capture_value, radians(25)) << "the palm looks forward";
  std::map<std::string, std::string> without = names;
  without["brachioradialis_r"] = "brachioradialis_r.vtp";
  write_body(folder.path() / "other" / "arm", elbow(), without);
  EXPECT_EQ(drafted_scene(folder.path() / "other" / "arm").scene.joints.size(), 1u);
}

TEST(JointsOfMadeBody, landmarks_say_where_a_joint_is_where_they_are_named) {
  const TestFolder folder;
  write_body(folder.path() / "hip", hip(), hip_names);
  std::ofstream(folder.path() / "hip" / "points.csv") << "cloud,index,x_mm,y_mm,z_mm\nthigh,HJC,1,2,3\n";
  const LoadedScene drafted = drafted_scene(folder.path() / "hip", {{{"hip_r", {"HJC"}}}});
  EXPECT_LT((joint_named(drafted.scene, "hip_r").frame.translation() - Vec3(0.001, 0.002, 0.003)).norm(), 1e-5);
  EXPECT_THROW(draft_scene(folder.path() / "hip", {{{"hip_r", {"HJ"}}}}), ConfigurationError);
  EXPECT_THROW(draft_scene(folder.path() / "hip", {{{"hop_r", {"HJC"}}}}), ConfigurationError);
}

TEST(JointsOfMadeBody, a_landmark_at_a_joint_s_center_leaves_its_fitted_axis) {
  const TestFolder folder;
  write_body(folder.path() / "arm", elbow(), forearm_names);
  std::ofstream(folder.path() / "arm" / "points.csv") << "cloud,index,x_mm,y_mm,z_mm\narm,EJC,0,5,0\n";
  const SceneDraft fitted = draft_scene(folder.path() / "arm"),
                   moved = draft_scene(folder.path() / "arm", {{{"elbow_r", {"EJC"}}}});
  const DraftJoint &before = fitted.skeleton.joints.at(0), &after = moved.skeleton.joints.at(0);
  ASSERT_EQ(after.name, "elbow_r");
  EXPECT_LT((after.center - Vec3(0, 0.005, 0)).norm(), 1e-9);
  EXPECT_LT((after.axes[0].direction - before.axes[0].direction).norm(), 1e-9);
  EXPECT_EQ(after.guess.certainty, before.guess.certainty);
}

TEST(JointsOfMadeBody, axes_beside_one_by_landmarks_are_at_right_angles_to_it) {
  const TestFolder folder;
  write_body(folder.path() / "hip", hip(), hip_names);
  std::ofstream(folder.path() / "hip" / "points.csv")
      << "cloud,index,x_mm,y_mm,z_mm\nhip,A,0,0,0\nhip,B,10,5,-40\nhip,C,0,0,0\n";
  const SceneDraft draft = draft_scene(folder.path() / "hip", {{{"hip_r", {"A", "B"}}}});
  const std::vector<DraftAxis>& axes = draft.skeleton.joints.at(0).axes;
  ASSERT_EQ(axes.size(), 3u);
  EXPECT_LT((axes[0].direction - Vec3(-10, -5, 40).normalized()).norm(), 1e-9) << "to the right, as it was";
  Eigen::Matrix3d all;
  for (int i = 0; i < 3; ++i) all.col(i) = axes[static_cast<std::size_t>(i)].direction;
  EXPECT_LT((all.transpose() * all - Eigen::Matrix3d::Identity()).norm(), 1e-9);
  EXPECT_THROW(draft_scene(folder.path() / "hip", {{{"hip_r", {"A", "C"}}}}), ConfigurationError);
}

TEST(JointsOfMadeBody, a_hand_far_from_its_radius_has_no_wrist) {
  const TestFolder folder;
  write_body(folder.path() / "arm", elbow(), forearm_names);
  Vec3 end = Vec3::Zero();
  for (const Bone& bone : elbow().bones)
    for (const auto& p : bone.surface.vertices.colwise())
      if (p.y() < end.y()) end = p;
  const TriangleMesh scaphoid = shapes::sphere(end - Vec3(0, 0.06, 0), 0.012, 2);
  write_surface(folder.path() / "arm" / "scaphoid_r.vtp", scaphoid.vertices, scaphoid.faces);
  const SceneDraft draft = draft_scene(folder.path() / "arm");
  ASSERT_EQ(draft.skeleton.joints.size(), 1u);
  EXPECT_EQ(draft.skeleton.joints[0].name, "elbow_r");
  EXPECT_THAT(draft.skeleton.guesses, testing::Contains(testing::Field(&Guess::how, testing::HasSubstr("'wrist_r'"))));
}

TEST(JointsOfMadeBody, tables_that_look_like_landmarks_are_named_where_they_cannot_be_read) {
  const TestFolder folder;
  write_body(folder.path() / "hip", hip(), hip_names);
  folder.write("hip/points.csv", "name,X (mm),Y (mm),Z (mm)\nHJC,1,2,3\n");
  folder.write("hip/my_landmarks.csv", "HJC;1;2;3\n");
  folder.write("hip/forces.csv", "time,force\n0,1\n");
  EXPECT_THAT(draft_scene(folder.path() / "hip").left_out,
              testing::UnorderedElementsAre(
                  testing::AllOf(testing::HasSubstr("points.csv:1"), testing::HasSubstr("cloud,index,x_mm")),
                  testing::HasSubstr("my_landmarks.csv:1")));
}

}  // namespace gracilis
