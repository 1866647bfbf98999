#include <gracilis/anatomy/activation/activation.hpp>
#include <gracilis/anatomy/builtin/builtin_elbow.hpp>
#include <gracilis/anatomy/builtin/builtin_hip.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/io/scene/demo_scene.hpp>

#include <gtest/gtest.h>

namespace gracilis {
namespace {

/// Everything that a scene's own code and the surfaces that were shaped when the program was built put together.
void expect_the_same(const Scene& scene, const Scene& shaped) {
  EXPECT_EQ(scene.name, shaped.name);
  EXPECT_EQ(scene.bodies, shaped.bodies);
  EXPECT_EQ(scene.joints.size(), shaped.joints.size());
  EXPECT_EQ(scene.motion.values, shaped.motion.values);
  ASSERT_EQ(scene.bones.size(), shaped.bones.size());
  for (std::size_t b = 0; b < scene.bones.size(); ++b) {
    const Bone &bone = scene.bones[b], &expected = shaped.bones[b];
    EXPECT_EQ(bone.name, expected.name);
    EXPECT_EQ(bone.body, expected.body) << bone.name;
    EXPECT_EQ(bone.surface.vertices, expected.surface.vertices) << bone.name;
    EXPECT_EQ(bone.surface.faces, expected.surface.faces) << bone.name;
  }
  ASSERT_EQ(scene.muscles.size(), shaped.muscles.size());
  for (std::size_t m = 0; m < scene.muscles.size(); ++m) {
    const Muscle &muscle = scene.muscles[m], &expected = shaped.muscles[m];
    EXPECT_EQ(muscle.name, expected.name);
    EXPECT_EQ(muscle.settings, expected.settings) << muscle.name;
    EXPECT_EQ(muscle.surface.vertices, expected.surface.vertices) << muscle.name;
    EXPECT_EQ(muscle.surface.faces, expected.surface.faces) << muscle.name;
    ASSERT_EQ(muscle.attachments.size(), expected.attachments.size()) << muscle.name;
    for (std::size_t a = 0; a < muscle.attachments.size(); ++a) {
      EXPECT_EQ(muscle.attachments[a].body, expected.attachments[a].body) << muscle.name;
      EXPECT_EQ(muscle.attachments[a].vertices, expected.attachments[a].vertices) << muscle.name;
      EXPECT_FALSE(muscle.attachments[a].vertices.empty()) << muscle.name;
    }
  }
}

TEST(DemoScene, the_hip_that_the_program_carries_is_the_one_that_is_shaped) {
  expect_the_same(demo_scene("hip"), builtin_hip());
}

TEST(DemoScene, the_elbow_that_the_program_carries_is_the_one_that_is_shaped) {
  expect_the_same(demo_scene("elbow"), builtin_elbow());
}

TEST(DemoScene, flexes_by_the_step_that_is_asked_for_and_activates_with_it) {
  DemoOptions options;
  options.flexion_deg = 10;
  options.step_deg = 2.5;
  options.activations = {{"iliacus_r", 0.4}};
  const Scene scene = load_demo(options, {}).scene;
  EXPECT_EQ(scene.motion.values.rows(), 5);
  EXPECT_NEAR(scene.motion.values(1, 0), radians(2.5), 1e-12);
  std::vector<Pose> poses(1);
  poses[0].coordinates = {radians(5), 0, 0};
  set_activations(scene, poses);
  for (std::size_t m = 0; m < scene.muscles.size(); ++m)
    EXPECT_NEAR(poses[0].activations[m], scene.muscles[m].name == "iliacus_r" ? 0.2 : 0, 1e-12);
}

TEST(DemoScene, an_activation_of_no_muscle_or_beyond_1_is_an_error) {
  DemoOptions options;
  options.activations = {{"iliacs_r", 0.4}};
  EXPECT_THROW(load_demo(options, {}), ConfigurationError);
  options.activations = {{"iliacus_r", 1.4}};
  EXPECT_THROW(load_demo(options, {}), ConfigurationError);
}

}  // namespace
}  // namespace gracilis
