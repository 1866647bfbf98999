#include <gracilis/methods/registry.hpp>
#include <gracilis/scene/validate.hpp>

#include <scenes_for_tests.hpp>
#include <surface_distance.hpp>

#include <gtest/gtest.h>

#include <algorithm>

/// A muscle whose insertion lies on another muscle.
namespace gracilis {
namespace {

std::unique_ptr<DeformationMethod> method_on_tubes(const Scene& scene) {
  return make_method(scene, [&](const DistanceFieldSettings& settings) {
    if (settings.cell_size == scene.distance_fields.cell_size) return tube_fields();
    std::vector<DistanceField> fields;
    for (const Bone& bone : scene.bones) fields.push_back(build_bone_field(bone, settings));
    return fields;
  });
}

Scene scene_by(const std::string& method) {
  Scene scene = end_on_muscle_scene();
  scene.method.name = method;
  scene.method.settings.clear();
  return scene;
}

Frame after(const Scene& scene, DeformationMethod& method, Real angle, Real activation = 0) {
  Pose pose;
  for (Real at = radians(2); at < angle + 1e-9; at += radians(2)) {
    pose = flexed(scene, at);
    pose.activations = {0, activation};
    method.advance(pose, usual_time_step);
  }
  return frame_of(method, pose, 1);
}

/// The largest change since rest of the distance of attached vertices from the tube's surface, m.
Real largest_parting(const Scene& scene, const Frame& frame) {
  const NearestTriangle rest(scene.muscles[0].surface), now({frame.muscles[0].points, scene.muscles[0].surface.faces});
  Real largest = 0;
  for (const Index v : scene.muscles[1].attachments[1].vertices)
    largest = std::max(largest, std::abs(now.query(frame.muscles[1].points.col(v)).distance -
                                         rest.query(scene.muscles[1].surface.vertices.col(v)).distance));
  return largest;
}

/// How far the middle of the tube's patch is along the tube, m.
Real height_of_patch(const Scene& scene, const Frame& frame) {
  return frame.muscles[0].points(Eigen::all, scene.muscle_bodies[0].patch).row(2).mean();
}

TEST(EndOnMuscle, a_scene_with_one_is_valid) { EXPECT_TRUE(validate(end_on_muscle_scene()).empty()); }

TEST(EndOnMuscle, a_muscle_that_lies_on_itself_by_way_of_another_is_refused) {
  Scene scene = end_on_muscle_scene();
  Attachment& end = scene.muscles[0].attachments[1];
  end.body = add_muscle_body(scene, "tube_on_rider", 1, scene.muscles[0].surface.vertices(Eigen::all, end.vertices));
  ASSERT_FALSE(validate(scene).empty());
  EXPECT_NE(validate(scene).front().what.find("lies on itself"), std::string::npos);
}

TEST(EndOnMuscle, hosts_come_before_their_guests) {
  Scene scene = end_on_muscle_scene();
  EXPECT_EQ(hosts_first(scene), (std::vector<std::vector<std::size_t>>{{0}, {1}}));
  std::swap(scene.muscles[0], scene.muscles[1]);
  scene.muscle_bodies[0].muscle = 1;
  EXPECT_EQ(hosts_first(scene), (std::vector<std::vector<std::size_t>>{{1}, {0}}));
}

class EndOnMuscleBy : public ::testing::TestWithParam<std::string> {};

TEST_P(EndOnMuscleBy, it_goes_with_the_muscle_that_it_lies_on) {
  const Scene scene = scene_by(GetParam());
  const auto method = method_on_tubes(scene);
  const Frame bent = after(scene, *method, radians(40));
  // The tube's middle goes 4 mm and more; what lies on it as a rigid patch parts by as much as the tube bends below it.
  const Vec3 went =
      (bent.muscles[0].points - scene.muscles[0].surface.vertices)(Eigen::all, scene.muscle_bodies[0].patch)
          .rowwise()
          .mean();
  EXPECT_GT(went.norm(), 0.003);
  EXPECT_LT(largest_parting(scene, bent), GetParam() == "xpbd" ? 1e-4 : 1.5e-3);
}

INSTANTIATE_TEST_SUITE_P(Methods, EndOnMuscleBy,
                         ::testing::Values("xpbd", "strings", "skinning", "arap", "pbd", "rbf", "tissue"),
                         [](const auto& variant) { return variant.param; });

class PullOnMuscleBy : public ::testing::TestWithParam<std::string> {};

TEST_P(PullOnMuscleBy, an_active_muscle_draws_the_one_that_it_ends_on) {
  Scene scene = scene_by(GetParam());
  scene.activation.signals = {{"rider", {0}, {1}}};
  const auto height_after = [&](Real activation) {
    const auto method = method_on_tubes(scene);
    Pose pose = flexed(scene, 0);
    pose.activations = {0, activation};
    for (int frame = 0; frame < 30; ++frame) method->advance(pose, usual_time_step);
    return height_of_patch(scene, frame_of(*method, pose, 30));
  };
  EXPECT_GT(height_after(1) - height_after(0), 0.001);
}

INSTANTIATE_TEST_SUITE_P(Methods, PullOnMuscleBy, ::testing::Values("xpbd", "tissue"),
                         [](const auto& variant) { return variant.param; });

TEST(EndOnMuscle, tissue_pulls_at_the_muscle_below_as_that_pulls_at_it) {
  Scene scene = scene_by("tissue");
  scene.activation.signals = {{"rider", {0}, {1}}};
  const auto method = method_on_tubes(scene);
  Pose pose = flexed(scene, 0);
  pose.activations = {0, 0.3};
  for (int frame = 0; frame < 60; ++frame) method->advance(pose, usual_time_step);
  const std::vector<MuscleForces> forces = method->muscle_forces({});
  ASSERT_EQ(forces[1].insertion.size(), 1u);
  EXPECT_EQ(forces[1].insertion[0].on, scene.muscle_bodies[0].body);
  const auto of_rider = std::find_if(forces[0].muscles.begin(), forces[0].muscles.end(),
                                     [](const ForceOn& each) { return each.on == 1; });
  ASSERT_NE(of_rider, forces[0].muscles.end());
  const Vec3 on_tube = forces[1].insertion[0].wrench.force;
  EXPECT_GT(on_tube.norm(), 1);
  // What keeps the two from overlapping beside the end takes part on both sides.
  const auto of_tube = std::find_if(forces[1].muscles.begin(), forces[1].muscles.end(),
                                    [](const ForceOn& each) { return each.on == 0; });
  ASSERT_NE(of_tube, forces[1].muscles.end());
  const Vec3 sum = on_tube + of_tube->wrench.force + of_rider->wrench.force;
  EXPECT_LT(sum.norm(), 0.001 * on_tube.norm());
}

}  // namespace
}  // namespace gracilis
