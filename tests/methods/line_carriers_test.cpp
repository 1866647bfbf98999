#include <gracilis/anatomy/coarser_muscle.hpp>
#include <gracilis/anatomy/finer_muscle.hpp>
#include <gracilis/anatomy/joint_pose.hpp>
#include <gracilis/anatomy/line_sections.hpp>
#include <gracilis/methods/cylinder/cylinder_surface.hpp>
#include <gracilis/methods/xpbd/motion.hpp>
#include <gracilis/methods/xpbd/xpbd_method.hpp>
#include <gracilis/scene/validate.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis {

/// A hinge about y at the origin, and a muscle of sections beside it, straight from one body to the other.
static Scene hinge_scene() {
  Scene scene;
  scene.name = "hinge";
  scene.bodies = {"upper", "lower"};
  scene.joints = {{"hinge", 0, 1, RigidTransform::Identity(), {{"flexion", Vec3::UnitY(), 0, -2, 2}}}};
  scene.contact.muscle = MuscleContact::none;
  Muscle muscle;
  muscle.name = "line";
  ActionLine& line = muscle.action_line;
  line.points.resize(3, 2);
  line.points << 0.03, 0.03, 0, 0, 0.2, -0.2;
  line.bodies = {0, 1};
  line.rays = 8;
  line.scaling = 4;
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
  ASSERT_TRUE(prepared.line);
  const Pose pose = pose_at(scene, std::vector<Real>{1.2});
  const Points carried = xpbd::carried_rest(prepared, pose).colwise() + prepared.origin;
  const PlacedSections sections = sections_at(*prepared.line, pose);
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
    const Points carried = xpbd::carried_rest(prepared, pose).colwise() + prepared.origin;
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
  for (int i = 1; i <= 24; ++i) method->advance(pose_at(scene, std::vector<Real>{-0.05 * i}));  // it stretches
  const Pose pose = pose_at(scene, std::vector<Real>{-1.2});
  Frame frame;
  method->write(frame);
  const Vec3 from(0.03, 0, 0.2), to = pose.bodies[1] * Vec3(0.03, 0, -0.2);
  // Beside the ends sections lean with the bones, which turn by 69 degrees.
  for (int k = 3; k < 14; ++k) {
    const Vec3 middle = frame.muscles[0].points.middleCols(8 * k, 8).rowwise().mean();
    const Vec3 along = (to - from).normalized(), off = middle - from;
    EXPECT_LT((off - off.dot(along) * along).norm(), 0.004) << k;
  }
}

}  // namespace gracilis
