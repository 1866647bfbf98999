#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/anatomy/sections/cylinder_surface.hpp>
#include <gracilis/geometry/section_frames.hpp>
#include <gracilis/methods/cylinder/cylinder_method.hpp>
#include <gracilis/methods/cylinder/section_collision.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/scene/validate.hpp>

#include <shapes.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis {

/// A straight rod of hexagons along z through (x, 0).
static SectionRings rod(Real x, Real radius) {
  Points ends(3, 2);
  ends << x, x, 0, 0, 0, 0.08;
  const Points line = subdivide_line(ends, 2);
  const Points vertices =
      section_vertices(line, section_frames(line, Vec3::UnitX()), Eigen::MatrixXd::Constant(6, 5, radius));
  return {6, line, vertices.leftCols(30)};
}

TEST(SectionCollision, a_transversal_measures_how_deep_two_sections_lie_in_each_other) {
  const SectionRings left = rod(0, 0.01), apart = rod(0.03, 0.01), across = rod(0.015, 0.01);
  // Ray 0 points to +x, ray 3 to -x.
  EXPECT_EQ(transversal_depth(left, {0, 2, 0}, apart, {1, 2, 3}), 0);
  // Corners at 0.010 and 0.005: each sees 5 mm on the way to its center.
  EXPECT_NEAR(transversal_depth(left, {0, 2, 0}, across, {1, 2, 3}), 0.01, 1e-12);
}

TEST(SectionCollision, a_section_moves_only_when_the_depth_exceeds_its_radius) {
  SectionRings rings = rod(0, 0.01);
  EXPECT_FALSE(yield_to_transversal(rings, {0, 2, 0}, 0.009));
  EXPECT_TRUE(yield_to_transversal(rings, {0, 2, 0}, 0.014));
  // From the corner at +x over the old center and 4 mm on.
  EXPECT_TRUE(rings.centers.col(2).isApprox(Vec3(-0.004, 0, 0.04), 1e-12));
  EXPECT_NEAR(rings.corner(2, 0).x(), 0.006, 1e-12);
  EXPECT_NEAR(rings.corner(1, 0).x(), 0.01, 1e-12);
}

TEST(SectionCollision, inflation_keeps_the_area) {
  SectionRings rings = rod(0, 0.01);
  const Real area = section_area(rings, 2);
  EXPECT_NEAR(area, 1.5 * std::sqrt(3.0) * 1e-4, 1e-15);
  std::vector<bool> fixed(6, false);
  for (const Index i : {0, 1}) {
    rings.corner(2, i) = rings.centers.col(2) + 0.7 * (rings.corner(2, i) - rings.centers.col(2));
    fixed[static_cast<std::size_t>(i)] = true;
  }
  EXPECT_LT(section_area(rings, 2), 0.95 * area);
  inflate(rings, 2, area, fixed);
  EXPECT_NEAR(section_area(rings, 2), area, 1e-15);
  EXPECT_NEAR((rings.corner(2, 0) - rings.centers.col(2)).norm(), 0.007, 1e-12);
}

TEST(SectionCollision, a_held_section_stays_as_it_is) {
  SectionRings rings = rod(0, 0.01);
  const Points before = rings.corners;
  inflate(rings, 2, 1, std::vector<bool>(6, true));
  EXPECT_EQ(rings.corners, before);
}

TEST(SectionCollision, another_muscles_surface_is_an_obstacle) {
  const SectionRings rings = rod(0, 0.01);
  const Obstacle cuts = obstacle_of(rings);
  EXPECT_TRUE(cuts({-0.02, 0.0001, 0.03}, {0.02, 0.0001, 0.03}));
  EXPECT_FALSE(cuts({-0.02, 0.02, 0.03}, {0.02, 0.02, 0.03}));
  EXPECT_FALSE(cuts({-0.002, 0.0001, 0.03}, {0.002, 0.0001, 0.03}));  // all of it inside
}

TEST(TriangleTree, a_segment_cuts_a_box_or_ends_before_it) {
  const TriangleTree hits(shapes::box({0, 0, 0}, {1, 1, 1}));
  EXPECT_TRUE(hits.cut({-1, 0.4, 0.3}, {0.5, 0.4, 0.3}));
  EXPECT_FALSE(hits.cut({-1, 0.4, 0.3}, {-0.5, 0.4, 0.3}));
  EXPECT_FALSE(hits.cut({0.2, 0.4, 0.3}, {0.5, 0.4, 0.3}));
  EXPECT_FALSE(hits.cut({-1, 1.4, 0.3}, {2, 1.4, 0.3}));
}

/// A rod between two ends on one body, and a box on another body that slides against it along x.
static Scene pressed_scene() {
  Scene scene;
  scene.name = "pressed";
  scene.method.name = "cylinder";
  scene.bodies = {"still", "press"};
  scene.bones = {{"still", 0, shapes::box({-0.1, -0.1, -0.05}, {0.1, 0.1, -0.01})},
                 {"press", 1, shapes::box({0.02, -0.05, 0.03}, {0.06, 0.05, 0.05})}};
  JointAxis slide{"slide", Vec3::UnitX(), 0, -1, 1};
  slide.translation = true;
  scene.joints = {{"rail", 0, 1, RigidTransform::Identity(), {slide}}};
  Muscle muscle;
  muscle.name = "rod";
  muscle.action_line.points.resize(3, 2);
  muscle.action_line.points << 0, 0, 0, 0, 0, 0.08;
  muscle.action_line.bodies = {0, 0};
  muscle.action_line.rays = 12;
  muscle.action_line.scaling = 2;
  const Points line = subdivide_line(muscle.action_line.points, 2);
  muscle.surface = {section_vertices(line, section_frames(line, Vec3::UnitX()), Eigen::MatrixXd::Constant(12, 5, 0.01)),
                    section_faces(5, 12)};
  muscle.attachments = {{"o", AttachmentEnd::origin, 0, {60}}, {"i", AttachmentEnd::insertion, 0, {61}}};
  scene.muscles = {muscle};
  scene.transversals = {{{0, 2, 0}, {}, {1}}};
  return scene;
}

TEST(CylinderMethod, a_tagged_section_gives_way_to_a_bone_and_keeps_its_area) {
  const Scene scene = pressed_scene();
  ASSERT_THAT(validate(scene), testing::IsEmpty());
  const auto method = make_cylinder_method(scene);
  method->advance(pose_at(scene, std::vector<Real>{-0.014}), usual_time_step);
  Frame frame;
  method->write(frame);
  const Points& points = frame.muscles[0].points;
  SectionRings rings{12, subdivide_line(scene.muscles[0].action_line.points, 2), points.leftCols(60)};
  const Points middle = points.middleCols(24, 12);
  EXPECT_LT(middle.row(0).maxCoeff(), 0.006 + 1e-4);  // the press stands at 0.006
  rings.centers.col(2) = middle.rowwise().mean();
  EXPECT_NEAR(section_area(rings, 2), section_area(rings, 1), 0.03 * section_area(rings, 1));
  EXPECT_LT((points.middleCols(12, 12) - scene.muscles[0].surface.vertices.middleCols(12, 12)).norm(), 1e-12);
  // Gone again, all is as it was.
  method->advance(pose_at(scene, std::vector<Real>{0}), usual_time_step);
  method->write(frame);
  EXPECT_LT((frame.muscles[0].points - scene.muscles[0].surface.vertices).norm(), 1e-12);
}

TEST(CylinderMethod, what_did_not_come_free_is_told_and_its_time_counted) {
  const Scene scene = pressed_scene();
  const auto method = make_cylinder_method(scene);
  StepReport report = method->advance(pose_at(scene, std::vector<Real>{-0.014}), usual_time_step);
  EXPECT_EQ(metric(report.muscles[0].metrics, "unresolved_transversals"), 0);
  EXPECT_GT(metric(report.muscles[0].metrics, "collision_rounds"), 0);
  EXPECT_GT(report.muscles[0].milliseconds, 0);
  // The press in the middle of the rod, from side to side: the section cannot leave it.
  Scene wide = scene;
  wide.method.settings["transversal_rounds"] = 20;
  wide.bones[1].surface = shapes::box({-0.06, -0.05, 0.03}, {0.06, 0.05, 0.05});
  const auto caught = make_cylinder_method(wide);
  wide.transversals[0].bones = {1};
  report = caught->advance(pose_at(wide, std::vector<Real>{0.055}), usual_time_step);
  EXPECT_EQ(metric(report.muscles[0].metrics, "unresolved_transversals"), 1);
  EXPECT_EQ(metric(report.muscles[0].metrics, "collision_rounds"), 20);
}

TEST(CylinderMethod, a_section_that_does_not_come_free_is_not_thrown_away) {
  // A blade just before the next section, which cuts the way to that one's corners however far the tagged section goes.
  Scene scene = pressed_scene();
  scene.bones[1].surface = shapes::box({0.02, -0.05, 0.0585}, {0.1, 0.05, 0.0595});
  const auto method = make_cylinder_method(scene);
  const StepReport report = method->advance(pose_at(scene, std::vector<Real>{-0.02}), usual_time_step);
  EXPECT_EQ(metric(report.muscles[0].metrics, "unresolved_transversals"), 1);
  Frame frame;
  method->write(frame);
  EXPECT_NEAR(frame.muscles[0].points.middleCols(24, 12).rowwise().mean().x(), 0, 1e-9);
}

TEST(CylinderMethod, a_section_that_lies_deep_takes_more_rounds_to_come_free) {
  Scene scene = pressed_scene();
  const auto unresolved_in = [&](int rounds) {
    scene.method.settings["transversal_rounds"] = rounds;
    const StepReport report =
        make_cylinder_method(scene)->advance(pose_at(scene, std::vector<Real>{-0.017}), usual_time_step);
    return metric(report.muscles[0].metrics, "unresolved_transversals");
  };
  EXPECT_EQ(unresolved_in(5), 1);
  EXPECT_EQ(unresolved_in(60), 0);
}

TEST(CylinderMethod, other_methods_refuse_transversals) {
  Scene scene = pressed_scene();
  EXPECT_THAT(validate_method(scene), testing::IsEmpty());
  scene.method.name = "skinning";
  ASSERT_EQ(validate_method(scene).size(), 1u);
  EXPECT_THAT(validate_method(scene)[0].what, testing::HasSubstr("'skinning' lets no sections give way"));
}

TEST(CylinderMethod, a_transversal_at_a_section_that_is_not_there_is_refused) {
  Scene scene = pressed_scene();
  scene.transversals[0].moved.section = 5;
  ASSERT_EQ(validate(scene).size(), 1u);
  EXPECT_THAT(validate(scene)[0].what, testing::HasSubstr("section 5"));
}

}  // namespace gracilis
