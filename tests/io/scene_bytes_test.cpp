#include <gracilis/io/scene/demo_scene.hpp>
#include <gracilis/io/scene/scene_bytes.hpp>
#include <gracilis/io/scene/scene_reader.hpp>

#include "io/scene_folder.hpp"

#include <gtest/gtest.h>

using namespace gracilis;

namespace {

Scene again(const Scene& scene) { return scene_of_bytes(scene_bytes(scene)); }

/// A scene that uses what built-in ones do not.
Scene rich_scene() {
  Scene scene = demo_scene("elbow");
  scene.name = "\"a\" scene";
  scene.joints[0].axes[0].translation = true;
  scene.method = {"strings", {{"support_reach", 0.05}}, {{"enabled", false}}};
  scene.distance_fields.resolution = 40;
  scene.sequence.hold_frames = 3;
  scene.axes.anterior = Vec3::UnitZ();
  scene.transversals = {{{0, 1, 2}, {-1, 0, 0}, {0, 1}}};
  scene.muscle_bodies = {{1, 0, {4, 5, 6}, {0, 1}, {0.25, 0.75}, Vec3(1, 2, 3)}};
  Muscle& muscle = scene.muscles[0];
  muscle.settings = {{"name", std::string("x")}, {"center", Vec3(1, 2, 3)}};
  muscle.fibers.shape = FiberTemplate::fan;
  muscle.contraction.paths = SurfacePaths::nearest_joined;
  muscle.given_fibers.append(Points::Random(3, 4));
  muscle.aponeuroses = {{AttachmentEnd::insertion, scene.bones[0].surface}};
  LinePoint point;
  point.moves_to[1] = {{0, 1}, {2, 3}, {4, 5}};
  point.frame.translate(Vec3(0, 0, 1));
  muscle.action_line.path.points = {point};
  muscle.action_line.path.wraps = {PlacedWrap{}};
  muscle.action_line.path.wraps[0].surface.kind = WrapSurface::Kind::torus;
  muscle.action_line.heads.emplace_back().name = "first";
  muscle.action_line.heads[0].shares = {0, 0.5, 1};
  return scene;
}

}  // namespace

TEST(SceneBytes, are_the_scene_again) {
  for (const Scene& scene : {demo_scene("hip"), demo_scene("elbow"), rich_scene()})
    EXPECT_EQ(scene_bytes(again(scene)), scene_bytes(scene));

  const Scene scene = rich_scene(), read = again(scene);
  EXPECT_EQ(read.name, scene.name);
  EXPECT_EQ(read.bodies, scene.bodies);
  EXPECT_EQ(read.bones[1].surface.vertices, scene.bones[1].surface.vertices);
  EXPECT_EQ(read.bones[1].surface.faces, scene.bones[1].surface.faces);
  EXPECT_EQ(read.joints[0].frame.matrix(), scene.joints[0].frame.matrix());
  EXPECT_TRUE(read.joints[0].axes[0].translation);
  EXPECT_EQ(read.joints[0].axes[0].axis, scene.joints[0].axes[0].axis);
  EXPECT_EQ(read.method.name, "strings");
  EXPECT_EQ(read.method.settings, scene.method.settings);
  EXPECT_EQ(read.method.contact, scene.method.contact);
  EXPECT_EQ(read.distance_fields.resolution, 40);
  EXPECT_EQ(read.sequence.hold_frames, 3);
  EXPECT_EQ(read.axes.anterior, Vec3::UnitZ());
  EXPECT_EQ(read.transversals[0].bones, scene.transversals[0].bones);
  EXPECT_EQ(read.muscle_bodies[0].shares, scene.muscle_bodies[0].shares);
  EXPECT_EQ(read.motion.values, scene.motion.values);
  const Muscle &muscle = read.muscles[0], &expected = scene.muscles[0];
  EXPECT_EQ(muscle.surface.vertices, expected.surface.vertices);
  EXPECT_EQ(muscle.attachments[1].vertices, expected.attachments[1].vertices);
  EXPECT_EQ(muscle.attachments[1].end, expected.attachments[1].end);
  EXPECT_EQ(muscle.settings, expected.settings);
  EXPECT_EQ(muscle.fibers.shape, FiberTemplate::fan);
  EXPECT_EQ(muscle.contraction.paths, SurfacePaths::nearest_joined);
  EXPECT_EQ(muscle.given_fibers.points, expected.given_fibers.points);
  EXPECT_EQ(muscle.aponeuroses[0].surface.faces, expected.aponeuroses[0].surface.faces);
  EXPECT_EQ(muscle.action_line.path.points[0].moves_to[1].slopes, (std::vector<Real>{4, 5}));
  EXPECT_EQ(muscle.action_line.path.points[0].frame.translation(), Vec3(0, 0, 1));
  EXPECT_EQ(muscle.action_line.path.wraps[0].surface.kind, WrapSurface::Kind::torus);
  EXPECT_EQ(muscle.action_line.heads[0].name, "first");
  EXPECT_EQ(muscle.action_line.heads[0].shares, (std::vector<Real>{0, 0.5, 1}));
}

TEST(SceneBytes, of_something_else_are_refused) {
  EXPECT_THROW(scene_of_bytes(""), InputError);
  EXPECT_THROW(scene_of_bytes("ply\nformat ascii 1.0\n"), InputError);
}
