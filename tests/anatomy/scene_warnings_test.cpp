#include <gracilis/anatomy/scene_warnings.hpp>

#include <shapes.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Two boxes, together 3 x 4 x 12 m, with a hinge whose range is 0 to 90 degrees.
Scene hinge(const Vec3& center = Vec3::Zero()) {
  Scene scene;
  scene.bodies = {"upper", "lower"};
  scene.bones = {{"upper", 0, shapes::box({0, 0, 0}, {3, 4, 6})}, {"lower", 1, shapes::box({0, 0, -6}, {3, 4, 0})}};
  scene.joints = {{"knee", 0, 1, RigidTransform::Identity(), {{"flexion", Vec3::UnitY(), 0, 0, radians(90)}}}};
  scene.joints[0].frame.translation() = center;
  return scene;
}

Scene moved_over(Scene scene, Real from, Real to) {
  scene.motion.coordinates = {"flexion"};
  scene.motion.times = {0, 1};
  scene.motion.values = (Eigen::MatrixXd(2, 1) << from, to).finished();
  return scene;
}

/// A muscle of 20 x 20 vertices, 1 mm apart, of which some are attached.
Scene attached(const std::vector<Index>& vertices) {
  Scene scene;
  Muscle muscle;
  muscle.name = "sheet";
  std::vector<Vec3> places;
  std::vector<Eigen::Vector3i> faces;
  for (Index j = 0; j < 20; ++j)
    for (Index i = 0; i < 20; ++i) {
      places.emplace_back(0.001 * i, 0.001 * j, 0);
      const int a = 20 * j + i;
      if (i < 19 && j < 19) faces.emplace_back(a, a + 1, a + 21), faces.emplace_back(a, a + 21, a + 20);
    }
  muscle.surface = shapes::mesh_of(places, faces);
  muscle.attachments = {{"end", AttachmentEnd::origin, 0, vertices, false}};
  scene.muscles = {muscle};
  return scene;
}

}  // namespace

TEST(SceneWarnings, tell_of_motions_that_leave_a_range_on_either_side_with_both_ranges) {
  EXPECT_THAT(warnings_about(hinge()), IsEmpty()) << "no motion";
  EXPECT_THAT(warnings_about(moved_over(hinge(), 0, radians(90))), IsEmpty());
  EXPECT_THAT(warnings_about(moved_over(hinge(), radians(-5e-7), radians(90 + 5e-7))), IsEmpty()) << "rounding";
  EXPECT_THAT(
      warnings_about(moved_over(hinge(), radians(10), radians(95.25))),
      ElementsAre("the motion takes flexion from 10 to 95.3 degrees, beyond the model's range of 0 to 90; it is "
                  "followed as it is"));
  EXPECT_EQ(warnings_about(moved_over(hinge(), radians(-0.1), radians(10))).size(), 1u);
  EXPECT_EQ(warnings_about(moved_over(hinge(), radians(-2e-6), radians(10))).size(), 1u);
  EXPECT_EQ(warnings_about(moved_over(hinge(), 0, radians(90 + 2e-6))).size(), 1u);
}

TEST(SceneWarnings, of_translations_are_in_millimetres) {
  Scene scene = moved_over(hinge(), 0, 0.0125);
  scene.joints[0].axes[0].translation = true;
  scene.joints[0].axes[0].range_max = 0.01;
  EXPECT_THAT(warnings_about(scene), ElementsAre(HasSubstr("from 0 to 12.5 mm, beyond the model's range of 0 to 10;")));
  scene.motion.values(1, 0) = 1e6;
  EXPECT_THAT(warnings_about(scene), ElementsAre(HasSubstr("from 0 to 1e+09 mm")));
}

TEST(SceneWarnings, tell_of_a_center_further_from_the_bones_than_these_are_large) {
  // The bones are 13 m across.
  EXPECT_THAT(warnings_about(hinge({0, 0, 6 + 12.9})), IsEmpty());
  EXPECT_THAT(warnings_about(hinge({0, 0, 6 + 13.1})),
              ElementsAre("joint 'knee': its center is 13.1 m from the bones of 'upper' and 'lower', which are 13 m "
                          "across; 'center_unit' says in which unit it is given"));
  Scene sliding = hinge({0, 0, 100});
  sliding.joints[0].axes[0].translation = true;
  EXPECT_THAT(warnings_about(sliding), IsEmpty()) << "a center says nothing where nothing turns";
  for (const std::size_t which : {0u, 1u}) {
    Scene without = hinge({0, 0, 100});
    without.bones.erase(without.bones.begin() + static_cast<std::ptrdiff_t>(which));
    EXPECT_THAT(warnings_about(without), IsEmpty()) << "of one body nothing is known";
  }
  Scene third = hinge({0, 0, 100});
  third.bodies.emplace_back("other");
  third.bones.push_back({"other", 2, shapes::box({0, 0, 99}, {1, 1, 101})});
  EXPECT_EQ(warnings_about(third).size(), 1u) << "bones of others do not count";
}

TEST(SceneWarnings, tell_of_attachments_of_a_handful_of_vertices_and_of_slivers) {
  std::vector<Index> handful, row, block;
  for (Index i = 0; i < 9; ++i) handful.push_back(40 + i);
  for (Index i = 0; i < 20; ++i) row.push_back(200 + i);
  for (Index i = 0; i < 20; ++i)
    for (Index j = 0; j < 5; ++j) block.push_back(20 * (j + 5) + i);
  EXPECT_THAT(warnings_about(attached(handful)),
              ElementsAre("attachment 'end' of sheet is held by a handful of vertices (9)"));
  EXPECT_THAT(warnings_about(attached(row)),
              ElementsAre("attachment 'end' of sheet is a sliver: 19 mm long and 1 mm wide on average"));
  handful.push_back(60);
  EXPECT_THAT(warnings_about(attached(handful)), IsEmpty()) << "ten of them";
  EXPECT_THAT(warnings_about(attached(block)), IsEmpty());
}

}  // namespace gracilis
