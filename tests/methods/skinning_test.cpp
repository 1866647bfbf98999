#include <gracilis/methods/skinning/skinning_method.hpp>
#include <gracilis/methods/xpbd/motion.hpp>

#include <scenes_for_tests.hpp>

#include <gtest/gtest.h>

namespace gracilis {
namespace {

Points skinned(const Scene& scene, const Pose& pose) {
  const auto method = make_skinning_method(scene);
  method->advance(pose, usual_time_step);
  return frame_of(*method, pose, 1).muscles[0].points;
}

}  // namespace

TEST(Skinning, is_where_the_predictor_of_xpbd_puts_a_muscle_that_bodies_carry) {
  XpbdSettings settings;
  settings.skinning = Skinning::bodies;
  const Scene scene = tube_scene(settings);
  const Pose pose = flexed(scene, radians(60));
  const xpbd::PreparedMuscle prepared = xpbd::prepare_muscle(scene, scene.muscles[0], tube_fields());
  const Points carried = xpbd::skinned_rest(prepared, pose, xpbd::make_muscle_state(prepared, scene.bodies.size()));
  const Points points = skinned(scene, pose);
  EXPECT_GT((points - scene.muscles[0].surface.vertices).colwise().norm().maxCoeff(), 0.05) << "nothing moved";
  for (Index p = 0; p < static_cast<Index>(carried.cols()); ++p)
    EXPECT_LT((carried.col(p) + prepared.origin - points.col(prepared.order[static_cast<std::size_t>(p)])).norm(),
              1e-7);
}

TEST(Skinning, attached_vertices_go_where_their_bodies_are) {
  const Scene scene = tube_scene();
  const Pose pose = flexed(scene, radians(90));
  const Points points = skinned(scene, pose);
  for (const Attachment& attachment : scene.muscles[0].attachments)
    for (const Index v : attachment.vertices)
      EXPECT_EQ(points.col(v), Points(pose.bodies[static_cast<std::size_t>(attachment.body)] *
                                      Vec3(scene.muscles[0].surface.vertices.col(v))));
}

TEST(Skinning, tendons_change_it) {
  Scene scene = tube_scene();
  const Pose pose = flexed(scene, radians(60));
  const Points graded = skinned(scene, pose);
  scene.method.name = "skinning";
  scene.method.settings["tendon_length"] = 0.0;
  const Points ungraded = skinned(scene, pose);
  EXPECT_GT((graded - ungraded).norm(), 1e-6);
  scene.muscles[0].settings["tendon_length"] = 0.03;
  EXPECT_EQ(skinned(scene, pose), graded) << "a muscle's own setting wins";
}

TEST(Skinning, a_muscle_that_is_attached_to_nothing_stays) {
  Scene scene = tube_scene();
  scene.muscles[0].attachments.clear();
  EXPECT_EQ(skinned(scene, flexed(scene, radians(60))), scene.muscles[0].surface.vertices);
}

}  // namespace gracilis
