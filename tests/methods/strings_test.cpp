#include <gracilis/anatomy/joints/joint_twists.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/methods/strings/strings_method.hpp>
#include <gracilis/methods/xpbd/motion.hpp>
#include <gracilis/strings/string_skin.hpp>

#include "../strings/string_scenes.hpp"

#include <gtest/gtest.h>

#include <numeric>

/// `method = "strings"`.
namespace gracilis {
namespace {

std::vector<DistanceField> far_fields(const Scene& scene) {
  std::vector<DistanceField> fields;
  for (const Bone& bone : scene.bones) fields.push_back(build_bone_field(bone, strings::far_field_settings()));
  return fields;
}

Scene arm(const SettingValues& settings = {}) {
  Scene scene = strings::arm_scene();
  scene.method.name = "strings";
  scene.method.settings = settings;
  return scene;
}

Points shape_at(const Scene& scene, Real angle) {
  const auto method = make_strings_method(scene, far_fields(scene));
  const Pose pose = flexed(scene, angle);
  method->advance(pose, usual_time_step);
  return frame_of(*method, pose, 1).muscles[0].points;
}

TEST(Strings, are_what_the_predictor_of_xpbd_follows) {
  const Scene scene = arm();
  const strings::Strung strung(strings::arm_scene());
  const Pose pose = flexed(scene, radians(60));
  strings::StringState state = strings::capture_state(strung.muscle, scene.bodies.size());
  strings::follow(strung.muscle, strung.bones, pose, state);
  const TriangleMesh& surface = scene.muscles[0].surface;
  const strings::StringSkin skin = bind_skin(strung.muscle, surface, strings::attached_bodies(scene.muscles[0]));
  EXPECT_EQ(skinned_by_strings(strung.muscle, skin, surface.vertices, surface.faces, state).vertices,
            shape_at(scene, radians(60)));
}

TEST(Strings, keep_a_belly_with_the_bone_that_it_lies_along) {
  const Scene scene = arm();
  const Points& rest = scene.muscles[0].surface.vertices;
  const Points bent = shape_at(scene, radians(90));
  Vec3 moved = Vec3::Zero();
  Index count = 0;
  for (Index v = 0; v < static_cast<Index>(rest.cols()); ++v)
    if (rest(2, v) > -0.05 && rest(2, v) < 0.05) moved += bent.col(v) - rest.col(v), ++count;
  moved /= static_cast<Real>(count);
  ASSERT_GT(count, 100);
  EXPECT_LT(std::hypot(moved.x(), moved.y()), 0.003) << "across the limb";
  EXPECT_NEAR(enclosed_volume(bent, scene.muscles[0].surface.faces),
              enclosed_volume(rest, scene.muscles[0].surface.faces), 1e-6 * 1.5e-4);
}

TEST(Strings, are_the_fibers_of_a_frame) {
  const Scene scene = arm({{"strings", 30}, {"segments", 16}});
  const auto method = make_strings_method(scene, far_fields(scene));
  const Frame capture = frame_of(*method, flexed(scene, 0), 0);
  const Pose pose = flexed(scene, radians(60));
  method->advance(pose, usual_time_step);
  const Frame bent = frame_of(*method, pose, 1);
  strings::StringSettings settings;
  settings.count = 30, settings.segments = 16;
  const strings::Strung strung(strings::arm_scene());
  const auto muscle = muscle_strings(scene, scene.muscles[0], strung.bones, settings);
  EXPECT_EQ(capture.muscles[0].fibers.count(), 30);
  EXPECT_EQ(capture.muscles[0].fibers.points, muscle->taut) << "taut in the capture pose, too";
  strings::StringState state = capture_state(*muscle, 2);
  follow(*muscle, strung.bones, pose, state);
  EXPECT_EQ(bent.muscles[0].fibers.points, state.places);
  EXPECT_EQ(bent.muscles[0].fibers.size(0), 17);
}

TEST(Strings, of_fibers_that_a_scene_brings_are_as_many) {
  Scene scene = arm();
  const Points& rest = scene.muscles[0].surface.vertices;
  for (const Real x : {-0.028, -0.02}) {
    Points line(3, 2);
    line << x, x, 0, 0, rest.row(2).maxCoeff() - 0.002, rest.row(2).minCoeff() + 0.002;
    scene.muscles[0].given_fibers.append(line);
  }
  const auto method = make_strings_method(scene, far_fields(scene));
  EXPECT_EQ(frame_of(*method, flexed(scene, 0), 0).muscles[0].fibers.count(), 2);
}

TEST(Strings, stand_where_a_scene_far_from_the_origin_does) {
  const Vec3 away(40, -30, 20);
  const Scene near = arm();
  Scene far = strings::arm_scene(away);
  far.method = near.method;
  const auto here = make_strings_method(near, far_fields(near)), there = make_strings_method(far, far_fields(far));
  here->advance(flexed(near, radians(50)), usual_time_step);
  there->advance(flexed(far, radians(50)), usual_time_step);
  const Points expected = frame_of(*here, {}, 1).muscles[0].fibers.points.colwise() + away;
  const Points found = frame_of(*there, {}, 1).muscles[0].fibers.points;
  // Fibers of a round tube turn with the rounding of its places; their middle does not.
  EXPECT_LT((found.rowwise().mean() - expected.rowwise().mean()).norm(), 1e-3);
}

/// What the method knows at an angle of the hinge, the one coordinate.
FiberActions actions_at(const Scene& scene, Real angle) {
  const auto method = make_strings_method(scene, far_fields(scene));
  method->advance(flexed(scene, angle), usual_time_step);
  return method->fiber_actions(joint_twists(scene, std::vector<Real>{angle})).at(0);
}

Real mean_length_at(const Scene& scene, Real angle) {
  const auto method = make_strings_method(scene, far_fields(scene));
  const Pose pose = flexed(scene, angle);
  method->advance(pose, usual_time_step);
  const std::vector<Real> lengths = polyline_lengths(frame_of(*method, pose, 1).muscles[0].fibers);
  return std::accumulate(lengths.begin(), lengths.end(), Real{0}) / static_cast<Real>(lengths.size());
}

Real arm_by_lengths(const Scene& scene, Real angle) {
  constexpr Real step = radians(2);
  return -(mean_length_at(scene, angle + step) - mean_length_at(scene, angle - step)) / (2 * step);
}

Real work_of(const FiberActions& actions, const std::vector<Twist>& twists) {
  Real work = 0;
  for (std::size_t b = 0; b < twists.size(); ++b) {
    const auto wrench = actions.wrenches.col(static_cast<Index>(b));
    work += wrench.head<3>().dot(twists[b].velocity) + wrench.tail<3>().dot(twists[b].turning);
  }
  return work;
}

TEST(Strings, know_their_moment_arms) {
  Scene scene = arm();
  const FiberActions actions = actions_at(scene, radians(60));
  ASSERT_EQ(actions.arms.rows(), 48);
  EXPECT_NEAR(actions.mean_arms[0], arm_by_lengths(scene, radians(60)), 1e-3);
  EXPECT_GT(actions.mean_arms[0], 0.01);
  scene.muscles[0].fibers.count = 0;
  EXPECT_EQ(actions_at(scene, radians(10)).arms.size(), 0) << "no fibers are wanted";
}

TEST(Strings, pull_where_a_scene_far_from_the_origin_is) {
  Scene far = strings::arm_scene(Vec3(40, -30, 20));
  far.method.name = "strings";
  const FiberActions actions = actions_at(far, radians(50));
  EXPECT_NEAR(actions.mean_arms[0], arm_by_lengths(far, radians(50)), 1e-3);
  EXPECT_NEAR(work_of(actions, joint_twists(far, std::vector<Real>{radians(50)})[0]), actions.mean_arms[0], 1e-4);
}

TEST(Strings, settings_reach_them) {
  const Points usual = shape_at(arm(), radians(60));
  for (const auto& [key, value] : SettingValues{{"strings", 20},
                                                {"segments", 12},
                                                {"support_length", 0.02},
                                                {"support_reach", 0.015},
                                                {"tie_length", 0.01},
                                                {"tie_reach", 0.05},
                                                {"bone_gap", 0.012},
                                                {"neighbors", 0},
                                                {"share_offset", 0.01},
                                                {"iterations", 1}})
    EXPECT_GT((shape_at(arm({{key, value}}), radians(60)) - usual).norm(), 1e-6) << key;
}

TEST(Strings, a_muscle_with_both_ends_on_one_body_goes_with_it) {
  Scene scene = arm();
  scene.muscles[0].attachments[0].body = 1;
  const Points& rest = scene.muscles[0].surface.vertices;
  const RigidTransform lower = flexed(scene, radians(70)).bodies[1];
  const Points shape = shape_at(scene, radians(70));
  for (Index v = 0; v < static_cast<Index>(rest.cols()); ++v)
    EXPECT_LT((shape.col(v) - lower * Vec3(rest.col(v))).norm(), 1e-9);
}

TEST(Strings, a_muscle_without_an_insertion_is_carried_by_its_bodies) {
  Scene scene = arm();
  scene.muscles[0].attachments[1].end = AttachmentEnd::origin;
  const Points shape = shape_at(scene, radians(40));
  EXPECT_TRUE(shape.allFinite());
  const RigidTransform lower = flexed(scene, radians(40)).bodies[1];
  for (const Index v : scene.muscles[0].attachments[1].vertices)
    EXPECT_LT((shape.col(v) - lower * Vec3(scene.muscles[0].surface.vertices.col(v))).norm(), 1e-12);
}

}  // namespace
}  // namespace gracilis
