#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/anatomy/resolution/coarser_muscle.hpp>
#include <gracilis/anatomy/resolution/finer_muscle.hpp>
#include <gracilis/anatomy/sections/cylinder_surface.hpp>
#include <gracilis/anatomy/sections/line_sections.hpp>
#include <gracilis/methods/xpbd/motion.hpp>
#include <gracilis/methods/xpbd/xpbd_method.hpp>
#include <gracilis/scene/validate.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis {

/// A hinge about y at the origin, and a muscle of 17 sections beside it, from the upper body to the lower; `line` is
/// straight from one to the other, or through points of the lower body.
static Scene hinge_scene(const Points& points = Points{{0.03, 0.03}, {0, 0}, {0.2, -0.2}}) {
  Scene scene;
  scene.name = "hinge";
  scene.bodies = {"upper", "lower"};
  scene.joints = {{"hinge", 0, 1, RigidTransform::Identity(), {{"flexion", Vec3::UnitY(), 0, -2, 2}}}};
  scene.method.contact["muscle"] = "none";
  Muscle muscle;
  muscle.name = "line";
  ActionLine& line = muscle.action_line;
  line.points = points;
  line.bodies.assign(static_cast<std::size_t>(points.cols()), 1);
  line.bodies[0] = 0;
  line.rays = 8;
  line.scaling = points.cols() == 2 ? 4 : 3;
  const Points centers = subdivide_line(line.points, line.scaling);
  muscle.surface = {
      section_vertices(centers, section_frames(centers, Vec3::UnitY()), Eigen::MatrixXd::Constant(8, 17, 0.01)),
      section_faces(17, 8)};
  muscle.attachments = {{"o", AttachmentEnd::origin, 0, {0, 1, 2, 3, 4, 5, 6, 7, 136}},
                        {"i", AttachmentEnd::insertion, 1, {128, 129, 130, 131, 132, 133, 134, 135, 137}}};
  scene.muscles = {muscle};
  return scene;
}

TEST(LineCarriers, sections_carry_the_surface_along_the_line) {
  const Scene scene = hinge_scene();
  ASSERT_THAT(validate(scene), testing::IsEmpty());
  const xpbd::PreparedMuscle prepared = xpbd::prepare_muscle(scene, scene.muscles[0], {});
  ASSERT_EQ(prepared.lines.size(), 1u);
  const Pose pose = pose_at(scene, std::vector<Real>{1.2});
  const Points carried = xpbd::skinned_rest(prepared, pose, {}).colwise() + prepared.origin;
  const PlacedSections sections = sections_at(prepared.lines[0], pose);
  Points middles = Points::Zero(3, 17);
  for (Index p = 0; p < carried.cols(); ++p)
    if (prepared.order[static_cast<std::size_t>(p)] < 136)
      middles.col(prepared.order[static_cast<std::size_t>(p)] / 8) += carried.col(p) / 8;
  for (int k = 0; k < 17; ++k) EXPECT_LT((middles.col(k) - sections.centers.col(k)).norm(), 1e-12) << k;
}

TEST(LineCarriers, finer_and_coarser_copies_follow_the_nearest_sections) {
  const Scene scene = hinge_scene();
  const Pose pose = pose_at(scene, std::vector<Real>{-1.2});
  const Vec3 from(0.03, 0, 0.2), to = pose.bodies[1] * Vec3(0.03, 0, -0.2), along = (to - from).normalized();
  for (const Muscle& copy : {finer_muscle(scene.muscles[0]), coarser_muscle(scene.muscles[0], 0.02).muscle}) {
    ASSERT_NE(copy.surface.vertex_count(), scene.muscles[0].surface.vertex_count());
    const xpbd::PreparedMuscle prepared = xpbd::prepare_muscle(scene, copy, {});
    const Points carried = xpbd::skinned_rest(prepared, pose, {}).colwise() + prepared.origin;
    for (Index p = 0; p < carried.cols(); ++p) {
      const Vec3 off = carried.col(p) - from;
      EXPECT_LT((off - off.dot(along) * along).norm(), 0.02) << p;  // the radius is 0.01
    }
  }
}

TEST(LineCarriers, a_muscle_by_xpbd_stays_along_its_line) {
  const Scene scene = hinge_scene();
  const std::vector<DistanceField> no_bones;
  const auto method = make_xpbd_method(scene, no_bones);
  for (int i = 1; i <= 24; ++i)
    method->advance(pose_at(scene, std::vector<Real>{-0.05 * i}), usual_time_step);  // it stretches
  const Pose pose = pose_at(scene, std::vector<Real>{-1.2});
  Frame frame;
  method->write(frame);
  const Vec3 from(0.03, 0, 0.2), to = pose.bodies[1] * Vec3(0.03, 0, -0.2);
  // Beside the ends sections lean with the bones, which turn by 69 degrees: this muscle has no tendon.
  for (int k = 3; k < 14; ++k) {
    const Vec3 middle = frame.muscles[0].points.middleCols(8 * k, 8).rowwise().mean();
    const Vec3 along = (to - from).normalized(), off = middle - from;
    EXPECT_LT((off - off.dot(along) * along).norm(), 0.004) << k;
  }
}

/// The same with a tendon in its lower third, and a line that ends at a point which moves with the flexion.
static Scene tendon_scene() {
  Scene scene = hinge_scene();
  ActionLine& line = scene.muscles[0].action_line;
  line.tendon = 0.13;
  LinePoint origin, insertion;
  origin.place = line.points.col(0);
  insertion.body = 1;
  insertion.moving = true;
  insertion.moves_with = {LineCoordinate{0, 0}, LineCoordinate{}, LineCoordinate{}};
  // 50 mm forward over a radian.
  insertion.moves_to = {HermiteCurve{{-2, 2}, {0.03 + 0.1, 0.03 - 0.1}, {-0.05, -0.05}}, HermiteCurve{{0}, {0}, {0}},
                        HermiteCurve{{0}, {-0.2}, {0}}};
  line.path.points = {origin, insertion};
  return scene;
}

/// The middle of each section after the flexion, in so many steps.
static Points middles_after(const Scene& scene, Real flexion, int steps, Real activation = 0) {
  const std::vector<DistanceField> no_bones;
  const auto method = make_xpbd_method(scene, no_bones);
  for (int i = 1; i <= steps; ++i) {
    Pose pose = pose_at(scene, std::vector<Real>{flexion * i / steps});
    if (activation > 0) pose.activations = {activation};
    method->advance(pose, usual_time_step);
  }
  Frame frame;
  method->write(frame);
  Points middles(3, 17);
  for (Index k = 0; k < 17; ++k) middles.col(k) = frame.muscles[0].points.middleCols(8 * k, 8).rowwise().mean();
  return middles;
}

TEST(LineCarriers, the_end_of_a_tendon_goes_where_its_line_ends) {
  const Scene scene = tendon_scene();
  ASSERT_THAT(validate(scene), testing::IsEmpty());
  const Pose pose = pose_at(scene, std::vector<Real>{-1.0});
  const Vec3 end = pose.bodies[1] * Vec3(0.03 + 0.05, 0, -0.2);
  EXPECT_LT((middles_after(scene, -1.0, 20).col(16) - end).norm(), 1e-6);
}

TEST(LineCarriers, an_active_belly_does_not_draw_its_tendon_across_a_bend_of_the_line) {
  // A tendon of 0.17 m that turns by 45 degrees in its middle.
  Scene scene = hinge_scene(Points{{0.03, 0.03, 0.1}, {0, 0, 0}, {0.2, -0.1, -0.17}});
  scene.muscles[0].action_line.tendon = 0.17;
  scene.muscles[0].fibers.count = 20;
  scene.activation.signals = {{"line", {0}, {0.5}}};
  ASSERT_THAT(validate(scene), testing::IsEmpty());
  const Points relaxed = middles_after(scene, 0.3, 40), active = middles_after(scene, 0.3, 40, 0.5);
  // The eighth section is where the line bends.
  for (Index k = 8; k <= 16; ++k) EXPECT_LT((active.col(k) - relaxed.col(k)).norm(), 0.0005) << k;
}

}  // namespace gracilis
