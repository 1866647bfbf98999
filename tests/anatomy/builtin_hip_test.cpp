#include <gracilis/anatomy/builtin/builtin_hip.hpp>
#include <gracilis/anatomy/builtin/builtin_hip_bones.hpp>
#include <gracilis/anatomy/builtin/builtin_hip_muscles.hpp>
#include <gracilis/anatomy/builtin/builtin_hip_sacrum.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/signed_distance.hpp>

#include <gtest/gtest.h>

#include <shaped_hip.hpp>

#include "builtin_scene_checks.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace gracilis {
namespace {

const Bone& bone_of_hip(const std::string& name) { return bone_of(shaped_hip(), name); }

TEST(BuiltinHip, has_two_bodies_four_bones_and_six_muscles_that_cross_the_hip) {
  EXPECT_EQ(shaped_hip().bodies, (std::vector<std::string>{"pelvis", "femur_r"}));
  std::map<std::string, Index> bones;
  for (const Bone& b : shaped_hip().bones) bones[b.name] = b.body;
  EXPECT_EQ(bones, (std::map<std::string, Index>{{"hip_bone_r", 0}, {"sacrum", 0}, {"hip_bone_l", 0}, {"femur_r", 1}}));
  std::set<std::string> muscles;
  for (const Muscle& m : shaped_hip().muscles) {
    muscles.insert(m.name);
    ASSERT_EQ(m.attachments.size(), 2u) << m.name;
    EXPECT_EQ(m.attachments[0].end, AttachmentEnd::origin);
    EXPECT_EQ(m.attachments[0].body, 0);
    EXPECT_EQ(m.attachments[1].end, AttachmentEnd::insertion);
    EXPECT_EQ(m.attachments[1].body, 1);
  }
  EXPECT_EQ(muscles, (std::set<std::string>{"gluteus_maximus_r", "gluteus_medius_r", "gluteus_minimus_r", "iliacus_r",
                                            "adductor_brevis_r", "adductor_longus_r"}));
}

TEST(BuiltinHip, every_surface_is_a_closed_manifold_that_looks_outwards) {
  for (const Bone& b : shaped_hip().bones) {
    expect_sound(b.name, b.surface, b.name.starts_with("hip_bone") ? 1 : 0);  // the obturator foramen
    EXPECT_LT(b.surface.face_count(), 20000) << b.name;
  }
  for (const Muscle& m : shaped_hip().muscles) {
    expect_sound(m.name, m.surface, 0);
    EXPECT_GT(m.surface.face_count(), 1200) << m.name;
    EXPECT_LT(m.surface.face_count(), 3300) << m.name;
  }
}

TEST(BuiltinHip, triangles_of_muscles_are_even) {
  for (const Muscle& m : shaped_hip().muscles) expect_even_triangles(m);
}

TEST(BuiltinHip, volumes_are_those_of_the_literature) {
  // Handsfield et al. 2014, regression at a height of 1.71 m and a mass of 71.8 kg, cm³.
  const std::map<std::string, Real> expected = {{"gluteus_maximus_r", 842.4}, {"gluteus_medius_r", 320.4},
                                                {"gluteus_minimus_r", 103.6}, {"iliacus_r", 175.4},
                                                {"adductor_brevis_r", 102.9}, {"adductor_longus_r", 160.8}};
  for (const Muscle& m : shaped_hip().muscles)
    EXPECT_NEAR(1e6 * enclosed_volume(m.surface.vertices, m.surface.faces), expected.at(m.name),
                0.01 * expected.at(m.name))
        << m.name;
}

TEST(BuiltinHip, muscles_keep_clear_of_bones_at_rest) { expect_clear_of_bones(shaped_hip()); }

TEST(BuiltinHip, muscles_keep_clear_of_each_other_at_rest) { expect_clear_of_each_other(shaped_hip()); }

TEST(BuiltinHip, attachments_are_areas_on_their_bones) {
  const SignedDistance hip_bone(bone_of_hip("hip_bone_r").surface), sacrum(bone_of_hip("sacrum").surface),
      femur(bone_of_hip("femur_r").surface);
  for (const Muscle& m : shaped_hip().muscles) {
    const auto areas = vertex_areas(m.surface.vertices, m.surface.faces);
    std::set<Index> seen;
    for (const Attachment& a : m.attachments) {
      Real area = 0;
      for (Index v : a.vertices) {
        EXPECT_TRUE(seen.insert(v).second) << "a vertex is attached twice in " << m.name;
        area += areas[v];
        const Vec3 p = m.surface.vertices.col(v);
        const Real gap =
            a.body == 0 ? std::min(hip_bone.query(p).distance, sacrum.query(p).distance) : femur.query(p).distance;
        EXPECT_LT(gap, 0.0043) << m.name << " " << a.name;
      }
      EXPECT_TRUE(std::is_sorted(a.vertices.begin(), a.vertices.end()));
      EXPECT_GE(a.vertices.size(), 12u) << m.name << " " << a.name;
      EXPECT_GT(1e4 * area, 3.5) << m.name << " " << a.name << " in cm²";
    }
  }
}

TEST(BuiltinHip, landmarks_lie_on_their_bones) {
  using builtin_hip_shapes::millimetres;
  const Landmark landmarks[] = {{"anterior superior iliac spine", "hip_bone_r", millimetres(71, 70, 38)},
                                {"posterior superior iliac spine", "hip_bone_r", millimetres(-78, 95, -46)},
                                {"ischial tuberosity", "hip_bone_r", millimetres(-55, -45, -25)},
                                {"pubic tubercle", "hip_bone_r", millimetres(50, -20, -64)},
                                {"greater trochanter", "femur_r", millimetres(-14, -18, 62)},
                                {"lesser trochanter", "femur_r", millimetres(-20, -60, 12)},
                                {"lateral epicondyle", "femur_r", millimetres(-4, -393, 42)},
                                {"medial epicondyle", "femur_r", millimetres(-4, -393, -42)}};
  for (const Landmark& landmark : landmarks) expect_on_bone(landmark, bone_of_hip(landmark.bone));
}

TEST(BuiltinHip, the_joint_turns_about_the_head_without_the_bones_touching) {
  const Joint& joint = shaped_hip().joints.at(0);
  EXPECT_EQ(joint.name, "hip_r");
  ASSERT_EQ(joint.axes.size(), 3u);
  EXPECT_EQ(joint.axes[0].coordinate, "hip_flexion_r");
  EXPECT_EQ(joint.axes[1].coordinate, "hip_adduction_r");
  EXPECT_EQ(joint.axes[2].coordinate, "hip_rotation_r");
  EXPECT_TRUE(joint.frame.translation().isZero());

  const auto turned = [&](Real flexion, Real adduction, Real rotation) {
    return RigidTransform(Eigen::AngleAxisd(flexion, joint.axes[0].axis) *
                          Eigen::AngleAxisd(adduction, joint.axes[1].axis) *
                          Eigen::AngleAxisd(rotation, joint.axes[2].axis));
  };
  const Vec3 knee(0, -0.4, 0), toes(0.1, -0.4, 0);
  EXPECT_GT((turned(0.5, 0, 0) * knee).x(), 0.1) << "flexion moves the knee forward";
  EXPECT_LT((turned(0, 0.5, 0) * knee).z(), -0.1) << "adduction moves the right knee to the left";
  EXPECT_LT((turned(0, 0, 0.5) * toes).z(), -0.04) << "internal rotation turns the right toes to the left";

  const SignedDistance hip_bone(bone_of_hip("hip_bone_r").surface);
  const Points& femur = bone_of_hip("femur_r").surface.vertices;
  for (const Vec3& pose : {Vec3(0, 0, 0), Vec3(45, 0, 0), Vec3(90, 0, 0), Vec3(-20, 0, 0), Vec3(0, -30, 0),
                           Vec3(0, 15, 0), Vec3(0, 0, 30), Vec3(0, 0, -30)}) {
    const RigidTransform transform = turned(radians(pose.x()), radians(pose.y()), radians(pose.z()));
    for (Index v = 0; v < femur.cols(); ++v)
      if (femur(1, v) > -0.12) {
        ASSERT_GT(hip_bone.query(transform * Vec3(femur.col(v)), 0.01).distance, 0.0005)
            << pose.transpose() << " degrees, at " << femur.col(v).transpose();
      }
  }
}

TEST(BuiltinHip, the_motion_flexes_to_ninety_degrees_one_by_one) {
  const Motion& motion = shaped_hip().motion;
  EXPECT_EQ(motion.coordinates, (std::vector<std::string>{"hip_flexion_r"}));
  ASSERT_EQ(motion.values.rows(), 91);
  ASSERT_EQ(motion.times.size(), 91u);
  EXPECT_EQ(motion.values(0, 0), 0);
  EXPECT_NEAR(motion.values(90, 0), radians(90), 1e-12);
  EXPECT_NEAR(motion.times[90], 1.5, 1e-12);
}

TEST(BuiltinHip, bones_of_one_body_do_not_overlap) {
  EXPECT_GT(least_distance(bone_of_hip("sacrum").surface, SignedDistance(bone_of_hip("hip_bone_r").surface)), 0);
  EXPECT_GT(least_distance(bone_of_hip("sacrum").surface, SignedDistance(bone_of_hip("hip_bone_l").surface)), 0);
  EXPECT_GT(least_distance(bone_of_hip("hip_bone_r").surface, SignedDistance(bone_of_hip("hip_bone_l").surface)), 0);
}

TEST(BuiltinHip, the_same_bits_for_any_number_of_threads) {
  const Scene& by_all = shaped_hip();
  const ThreadLimit limit(1);
  expect_same_surfaces(builtin_hip(), by_all);
}

}  // namespace
}  // namespace gracilis
