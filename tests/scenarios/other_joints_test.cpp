// Joints unlike the hip and the elbow that the default method was made for: tendons that turn around an ankle, muscles
// around a radius that turns beside its ulna, a sheet over the head of a humerus, straps along a spine of six joints.
// Shapes are rough, made of swept balls.
#include "scenario_runs.hpp"

#include <gracilis/anatomy/builtin/builtin_parts.hpp>
#include <gracilis/anatomy/builtin/builtin_shapes.hpp>

#include <gtest/gtest.h>

#include <numbers>

namespace gracilis {
namespace {

using builtin_shapes::MusclePlan;
using builtin_shapes::Skeleton;
using builtin_shapes::thick;

/// A cross-section: its middle, half its width and half its thickness; mm.
struct Section {
  Real x, y, z, width, thickness;
};

/// Where a muscle is attached: on which body, and along which share of its length.
struct End {
  Index body;
  Real share;
};

/// The muscle through these sections, its width along `across`, with the volume of the tube through them.
MusclePlan muscle(const std::string& name, const Vec3& across, const std::vector<Section>& sections, End origin,
                  End insertion) {
  MusclePlan plan;
  plan.name = name;
  plan.net.rows = static_cast<Index>(sections.size());
  plan.net.columns = 2;
  for (const Section& section : sections)
    for (const Real side : {-1, 1}) {
      const Vec3 at = Vec3(section.x, section.y, section.z) +
                      side * std::max(section.width - section.thickness, Real(0.4)) * across;
      plan.net.points.push_back(thick(at.x(), at.y(), at.z(), section.thickness));
    }
  const auto area = [](const Section& section) {
    const Real flat = section.width - section.thickness;
    return (std::numbers::pi * section.thickness + 4 * flat) * section.thickness;
  };
  for (std::size_t i = 1; i < sections.size(); ++i) {
    const Section &a = sections[i - 1], &b = sections[i];
    plan.volume += 1e-9 * (Vec3(a.x, a.y, a.z) - Vec3(b.x, b.y, b.z)).norm() * (area(a) + area(b)) / 2;
  }
  plan.belly_from = 0.1;
  plan.belly_until = 0.6;
  plan.faces = 3000;
  plan.roundness = 0.0015;  // tendons are thin
  plan.origin_until = origin.share;
  plan.insertion_from = 1 - insertion.share;
  plan.origin_body = origin.body;
  plan.insertion_body = insertion.body;
  return plan;
}

Scene scene_of(const std::string& name, Skeleton skeleton, const std::vector<MusclePlan>& plans, const Vec3& center,
               const Vec3& axis, Real last) {
  Scene scene;
  scene.name = name;
  scene.bodies = {"still", "moving"};
  Joint joint{"joint", 0, 1, RigidTransform(Eigen::Translation3d(1e-3 * center)), {}};
  joint.axes = {{"angle", axis.normalized(), 0, 0, last}};
  scene.joints = {joint};
  scene.muscles = make_muscles(plans, skeleton, {});
  scene.bones = std::move(skeleton.bones);
  scene.motion = builtin_shapes::ramp_from_zero(name, "angle", last, radians(2), 1.0 / 60);
  return scene;
}

/// A right ankle: x forward, y up, z to the right. `side` 1 takes the toes up, -1 down.
Scene ankle(Real side, Real last) {
  Skeleton bones;
  add_bone(bones, "tibia", 0,
           thick_curve({thick(0, 400, 0, 22), thick(2, 330, 0, 13), thick(2, 200, 0, 11), thick(0, 90, 0, 12),
                        thick(0, 62, 0, 16)}));
  add_bone(bones, "fibula", 0,
           thick_curve({thick(-12, 385, 32, 8), thick(-14, 220, 33, 6), thick(-12, 90, 32, 6), thick(-8, 28, 34, 8)}));
  add_bone(bones, "foot", 1,
           thick_curve({thick(-58, -4, 4, 16), thick(-25, 6, 4, 17), thick(5, 22, 4, 15), thick(35, 8, 4, 16),
                        thick(90, -8, 5, 12), thick(140, -18, 6, 9)}));
  const Vec3 z = Vec3::UnitZ();
  const std::vector<MusclePlan> muscles = {muscle("tibialis_anterior", z,
                                                  {{15, 350, 12, 6, 4},
                                                   {22, 290, 17, 11, 9},
                                                   {23, 220, 14, 9, 9},
                                                   {23, 130, 8, 5, 4},
                                                   {25, 80, 0, 4, 3.5},
                                                   {32, 50, -6, 4, 3.5},
                                                   {48, 27, -12, 4, 3.5},
                                                   {70, 13, -6, 5, 3.5},
                                                   {86, 5, -3, 5, 3.5}},
                                                  {0, 0.3}, {1, 0.15}),
                                           muscle("soleus", z,
                                                  {{-13, 360, 11, 10, 5},
                                                   {-34, 300, 14, 22, 12},
                                                   {-40, 220, 12, 20, 12},
                                                   {-46, 130, 8, 10, 6},
                                                   {-56, 70, 5, 7, 4},
                                                   {-68, 30, 4, 7, 4},
                                                   {-73, 2, 4, 8, 4}},
                                                  {0, 0.2}, {1, 0.2}),
                                           muscle("fibularis_longus", Vec3::UnitX(),
                                                  {{-12, 345, 43, 4, 4},
                                                   {-13, 280, 46, 8, 6},
                                                   {-16, 200, 45, 7, 6},
                                                   {-22, 110, 43, 4, 3.7},
                                                   {-22, 60, 42, 3.5, 3.5},
                                                   {-21, 28, 40, 3.5, 3.5},
                                                   {-12, 8, 34, 3.5, 3.5},
                                                   {10, -4, 28, 3.5, 3.5},
                                                   {40, -4, 19, 4, 3.5}},
                                                  {0, 0.3}, {1, 0.1})};
  return scene_of("ankle", std::move(bones), muscles, {0, 28, 4}, side * z, last);
}

/// A right forearm, its palm forward; the radius turns about the line from its head to that of the ulna. `side` 1
/// supinates further.
Scene forearm(Real side, Real last) {
  Skeleton bones;
  add_bone(bones, "ulna", 0,
           thick_curve({thick(-8, 275, -2, 11), thick(0, 240, 0, 9), thick(2, 150, 2, 7), thick(0, 40, 0, 6),
                        thick(0, 8, 0, 8)}));
  add_bone(bones, "radius", 1,
           thick_curve({thick(4, 248, 20, 10), thick(3, 225, 20, 7), thick(6, 140, 30, 8), thick(4, 60, 30, 9),
                        thick(4, 8, 28, 12)}));
  const Vec3 y = Vec3::UnitY();
  const std::vector<MusclePlan> muscles = {muscle("pronator_teres", y,
                                                  {{4, 272, -8, 7, 5},
                                                   {16, 250, -8, 9, 7},
                                                   {19, 210, 8, 9, 6},
                                                   {19, 175, 24, 8, 4.5},
                                                   {15, 150, 38, 6, 3.5},
                                                   {8, 135, 40, 6, 3.2}},
                                                  {0, 0.15}, {1, 0.15}),
                                           muscle("pronator_quadratus", y,
                                                  {{4, 50, -7, 18, 3.2},
                                                   {10, 50, 2, 20, 3.5},
                                                   {16, 50, 14, 20, 4},
                                                   {16, 50, 26, 20, 3.5},
                                                   {13, 50, 37, 18, 3.2}},
                                                  {0, 0.25}, {1, 0.25}),
                                           muscle("supinator", y,
                                                  {{-10, 225, 2, 12, 3.2},
                                                   {-12, 220, 14, 15, 3.5},
                                                   {-9, 212, 27, 16, 3.5},
                                                   {1, 203, 32, 15, 3.2},
                                                   {10, 196, 29, 13, 3.2}},
                                                  {0, 0.2}, {1, 0.25})};
  return scene_of("forearm", std::move(bones), muscles, {4, 245, 20}, side * Vec3(4, 237, 20), last);
}

/// A right shoulder whose arm is lifted sideways; the shoulder blade stays.
Scene shoulder(Real last) {
  Skeleton bones;
  add_bone(bones, "scapula", 0,
           thick_curve({thick(-50, 1330, 80, 10), thick(-44, 1395, 90, 10), thick(-20, 1402, 138, 13)}));
  add_bone(bones, "acromion", 0,
           thick_curve({thick(-60, 1420, 84, 7), thick(-46, 1438, 120, 7), thick(-22, 1450, 160, 7),
                        thick(4, 1450, 184, 7), thick(26, 1444, 180, 7)}));
  add_bone(bones, "humerus", 1,
           thick_curve({thick(-2, 1402, 174, 24), thick(0, 1380, 186, 18), thick(2, 1320, 194, 12),
                        thick(3, 1200, 200, 11), thick(4, 1130, 202, 13)}));
  const Vec3 x = Vec3::UnitX();
  const std::vector<MusclePlan> muscles = {muscle("supraspinatus", x,
                                                  {{-41, 1407, 86, 12, 6},
                                                   {-34, 1426, 106, 12, 8},
                                                   {-22, 1431, 132, 11, 6},
                                                   {-12, 1431, 158, 10, 4},
                                                   {-6, 1430, 174, 10, 3.5},
                                                   {0, 1420, 195, 9, 3.5},
                                                   {1, 1411, 199, 9, 3.5}},
                                                  {0, 0.3}, {1, 0.15}),
                                           muscle("deltoid", x,
                                                  {{4, 1458, 192, 30, 5},
                                                   {2, 1446, 212, 36, 7},
                                                   {2, 1410, 220, 36, 11},
                                                   {2, 1360, 219, 28, 12},
                                                   {3, 1310, 214, 16, 8},
                                                   {4, 1276, 211, 9, 5}},
                                                  {0, 0.3}, {1, 0.15})};
  return scene_of("shoulder", std::move(bones), muscles, {-2, 1402, 174}, -x, last);
}

/// A trunk: five vertebrae between a pelvis and a thorax that stand on each other, each bent by its share of the same
/// motion. x forward, y up. `side` 1 bends it backward, -1 forward.
Scene trunk(Real side, Real last) {
  Skeleton bones;
  add_bone(bones, "sacrum", 0, thick_curve({thick(-30, -60, 0, 14), thick(-18, -20, 0, 20), thick(-6, 8, 0, 20)}));
  add_bone(bones, "pubis", 0, thick_curve({thick(40, -88, 12, 9), thick(55, -95, 0, 10), thick(40, -88, -12, 9)}));
  constexpr int vertebrae = 5;
  constexpr Real height = 34, lowest = 38;
  Scene scene;
  scene.bodies = {"pelvis"};
  for (int i = 0; i <= vertebrae; ++i) {
    const Real middle = lowest + i * height;
    const std::string body = i < vertebrae ? "l" + std::to_string(vertebrae - i) : "thorax";
    scene.bodies.push_back(body);
    Joint joint{body, i, i + 1, RigidTransform(Eigen::Translation3d(-0.004, 1e-3 * (middle - height / 2), 0)), {}};
    joint.axes = {{"bend_" + body, side * Vec3::UnitZ(), 0, 0, last}};
    scene.joints.push_back(joint);
    if (i == vertebrae) break;
    add_bone(bones, body, i + 1, thick_curve({thick(0, middle - 4, 0, 20), thick(0, middle + 4, 0, 20)}));
    add_bone(bones, body + "_spine", i + 1, thick_curve({thick(-20, middle, 0, 8), thick(-50, middle - 6, 0, 6)}));
  }
  const Index thorax = vertebrae + 1;
  add_bone(bones, "spine", thorax, thick_curve({thick(0, 212, 0, 20), thick(-14, 300, 0, 20), thick(-16, 360, 0, 20)}));
  add_bone(bones, "ribs", thorax,
           thick_curve({thick(-45, 300, 0, 10), thick(-60, 292, 45, 6), thick(-30, 262, 110, 6), thick(60, 215, 105, 6),
                        thick(104, 230, 30, 7), thick(108, 240, 0, 9)}));
  const Vec3 z = Vec3::UnitZ();
  const std::vector<MusclePlan> muscles = {muscle("erector_spinae", z,
                                                  {{-42, -34, 10, 9, 6},
                                                   {-50, 10, 22, 14, 11},
                                                   {-50, 80, 24, 16, 13},
                                                   {-50, 150, 26, 16, 13},
                                                   {-56, 220, 28, 15, 9},
                                                   {-64, 268, 33, 13, 6},
                                                   {-66, 297, 38, 9, 4}},
                                                  {0, 0.12}, {thorax, 0.1}),
                                           muscle("rectus_abdominis", z,
                                                  {{112, 222, 16, 16, 4},
                                                   {126, 170, 22, 24, 6},
                                                   {128, 90, 20, 24, 7},
                                                   {115, 20, 16, 20, 7},
                                                   {90, -50, 12, 12, 6},
                                                   {60, -93, 8, 9, 4}},
                                                  {thorax, 0.12}, {0, 0.15})};
  scene.name = "trunk";
  scene.muscles = make_muscles(muscles, bones, {});
  scene.bones = std::move(bones.bones);
  const Motion of_one = builtin_shapes::ramp_from_zero("trunk", "", last, last / 10, 1.0 / 60);
  scene.motion = {"trunk", {}, of_one.times, of_one.values.replicate(1, vertebrae + 1)};
  for (const Joint& joint : scene.joints) scene.motion.coordinates.push_back(joint.axes.front().coordinate);
  return scene;
}

void expect_gates_of(const Scene& scene) {
  for (const Muscle& each : scene.muscles)
    for (const Attachment& attachment : each.attachments)
      ASSERT_GT(attachment.vertices.size(), 5u) << each.name << " " << attachment.name;
  expect_gates(scene, run_whole(scene));
}

}  // namespace

TEST(OtherJoints, tendons_turn_around_an_ankle_bent_either_way) {
  expect_gates_of(ankle(-1, radians(40)));
  expect_gates_of(ankle(1, radians(20)));
}

TEST(OtherJoints, muscles_wind_around_a_radius_that_turns_either_way) {
  expect_gates_of(forearm(1, radians(60)));
  expect_gates_of(forearm(-1, radians(60)));
}

TEST(OtherJoints, straps_along_a_spine_of_six_joints_bend_with_it_either_way) {
  expect_gates_of(trunk(-1, radians(8)));
  expect_gates_of(trunk(1, radians(4)));
}

TEST(OtherJoints, muscles_over_a_humeral_head_follow_an_arm_that_is_lifted) { expect_gates_of(shoulder(radians(90))); }

}  // namespace gracilis
