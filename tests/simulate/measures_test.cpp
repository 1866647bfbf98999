#include <gracilis/simulate/measures.hpp>
#include <gracilis/simulate/run.hpp>

#include <scenes_for_tests.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace gracilis {
namespace {

/// A box bone on body 1 and a ball of muscle 15 mm beside it, attached with the vertex farthest away.
///
///   x = 0 ... 40 mm bone,  55 ... 95 mm muscle (center at 75 mm, radius 20 mm)
Scene ball_beside_a_box() {
  Scene scene;
  scene.bodies = {"ground", "moving"};
  scene.bones = {{"box", 1, shapes::box({0, -0.05, -0.05}, {0.04, 0.05, 0.05})}};
  Muscle muscle;
  muscle.name = "ball";
  muscle.surface = shapes::sphere({0.075, 0, 0}, 0.02, 2);
  muscle.attachments = {{"far side", AttachmentEnd::origin, 0, {0}, false}};  // vertex 0 is at x = 95 mm
  scene.muscles = {muscle};
  return scene;
}

Pose pose_with(const RigidTransform& moving) {
  Pose pose;
  pose.bodies = {RigidTransform::Identity(), moving};
  return pose;
}

MuscleMeasures measure(const Scene& scene, const Frame& frame) { return Measurer(scene).measure(frame).at(0); }

Frame frame_with(const Points& points, const RigidTransform& moving = RigidTransform::Identity()) {
  Frame frame;
  frame.pose = pose_with(moving);
  frame.muscles = {{points}};
  return frame;
}

bool equal(const MuscleMeasures& a, const MuscleMeasures& b) {
  return a.volume_ratio == b.volume_ratio && a.edge_ratio_mean == b.edge_ratio_mean &&
         a.edge_ratio_max == b.edge_ratio_max && a.edge_ratio_max_free == b.edge_ratio_max_free &&
         a.dihedral_change_mean == b.dihedral_change_mean && a.dihedral_change_max == b.dihedral_change_max &&
         a.dihedrals_over_90 == b.dihedrals_over_90 && a.vertex_depth == b.vertex_depth &&
         a.vertex_depth_beyond_rest == b.vertex_depth_beyond_rest &&
         a.midpoint_depth_beyond_rest == b.midpoint_depth_beyond_rest &&
         a.muscle_depth_beyond_rest == b.muscle_depth_beyond_rest && a.deepest_in == b.deepest_in &&
         a.belly_off_place == b.belly_off_place && a.wrong_side == b.wrong_side && a.slack == b.slack &&
         a.finite == b.finite;
}

}  // namespace

TEST(Measurer, finds_nothing_to_say_at_rest) {
  const Scene scene = ball_beside_a_box();
  const MuscleMeasures rest = measure(scene, frame_with(scene.muscles[0].surface.vertices));
  EXPECT_EQ(rest.volume_ratio, 1);
  EXPECT_EQ(rest.edge_ratio_max, 1);
  EXPECT_NEAR(rest.edge_ratio_mean, 1, 1e-12);
  EXPECT_EQ(rest.dihedral_change_max, 0);
  EXPECT_EQ(rest.vertex_depth, 0);
  EXPECT_EQ(rest.midpoint_depth_beyond_rest, 0);
  EXPECT_TRUE(rest.finite);
  EXPECT_THAT(missed_gates(rest, {}), testing::IsEmpty());
}

TEST(Measurer, knows_the_depth_of_a_vertex_in_a_box) {
  const Scene scene = ball_beside_a_box();
  Points points = scene.muscles[0].surface.vertices;
  points.col(1).x() = 0.037;  // 3 mm behind the face x = 40 mm
  const MuscleMeasures measures = measure(scene, frame_with(points));
  EXPECT_NEAR(measures.vertex_depth, 0.003, 1e-12);
  EXPECT_NEAR(measures.vertex_depth_beyond_rest, 0.003, 1e-12);
  EXPECT_EQ(measures.midpoint_depth_beyond_rest, 0) << "its edges' middles are still outside";
}

TEST(Measurer, knows_the_depth_of_a_midpoint_whose_ends_are_both_outside) {
  Scene scene = ball_beside_a_box();
  Points points = scene.muscles[0].surface.vertices;
  const MeshEdge edge =
      build_topology(scene.muscles[0].surface.faces, scene.muscles[0].surface.vertex_count()).edges.back();
  points.col(edge.a) = Vec3(0.02, 0.049, -0.06), points.col(edge.b) = Vec3(0.02, 0.049, 0.06);
  const MuscleMeasures measures = measure(scene, frame_with(points));
  EXPECT_NEAR(measures.midpoint_depth_beyond_rest, 0.001, 1e-12);
  EXPECT_EQ(measures.vertex_depth, 0);
}

TEST(Measurer, follows_the_bone) {
  const Scene scene = ball_beside_a_box();
  const RigidTransform closer(Eigen::Translation3d(0.018, 0, 0));
  const MuscleMeasures measures = measure(scene, frame_with(scene.muscles[0].surface.vertices, closer));
  EXPECT_NEAR(measures.vertex_depth, 0.003, 1e-12);
}

TEST(Measurer, depth_at_rest_is_forgiven_and_attached_vertices_are_not_asked) {
  Scene scene = ball_beside_a_box();
  scene.muscles[0].surface.vertices.col(1).x() = 0.037;
  Points points = scene.muscles[0].surface.vertices;
  points.col(1).x() = 0.036;
  MuscleMeasures measures = measure(scene, frame_with(points));
  EXPECT_NEAR(measures.vertex_depth, 0.004, 1e-12);
  EXPECT_NEAR(measures.vertex_depth_beyond_rest, 0.001, 1e-12);
  scene.muscles[0].attachments[0].vertices = {1};
  measures = measure(scene, frame_with(points));
  EXPECT_EQ(measures.vertex_depth, 0);
}

TEST(Measurer, of_a_scaled_muscle_says_its_scale) {
  const Scene scene = ball_beside_a_box();
  const Points points = 1.1 * scene.muscles[0].surface.vertices;
  const MuscleMeasures measures = measure(scene, frame_with(points));
  EXPECT_NEAR(measures.volume_ratio, 1.1 * 1.1 * 1.1, 1e-12);
  EXPECT_NEAR(measures.edge_ratio_mean, 1.1, 1e-12);
  EXPECT_NEAR(measures.edge_ratio_max, 1.1, 1e-12);
  EXPECT_NEAR(measures.dihedral_change_max, 0, 1e-9);
}

TEST(Measurer, edges_within_15_millimetres_of_an_attachment_do_not_count_as_free) {
  const Scene scene = ball_beside_a_box();
  Points points = scene.muscles[0].surface.vertices;
  points.col(0).x() += 0.05;  // the attached vertex: only edges next to it change
  MuscleMeasures measures = measure(scene, frame_with(points));
  EXPECT_GT(measures.edge_ratio_max, 3);
  EXPECT_EQ(measures.edge_ratio_max_free, 1);
  points = scene.muscles[0].surface.vertices;
  points.col(1).x() -= 0.005;  // on the opposite side
  measures = measure(scene, frame_with(points));
  EXPECT_GT(measures.edge_ratio_max_free, 1.05);
  EXPECT_EQ(measures.edge_ratio_max_free, measures.edge_ratio_max);
}

TEST(Measurer, counts_dihedrals_turned_by_more_than_a_right_angle) {
  const Scene scene = ball_beside_a_box();
  Points points = scene.muscles[0].surface.vertices;
  points.col(1).x() += 0.025;  // pushed through the ball: a deep, steep dent
  const MuscleMeasures measures = measure(scene, frame_with(points));
  EXPECT_GT(measures.dihedrals_over_90, 0);
  EXPECT_GT(measures.dihedral_change_max, pi / 2);
  EXPECT_LT(measures.dihedral_change_mean, measures.dihedral_change_max);
}

TEST(Measurer, a_coordinate_that_is_not_finite_is_said_and_ends_the_matter) {
  const Scene scene = ball_beside_a_box();
  Points points = scene.muscles[0].surface.vertices;
  points(2, 5) = std::numeric_limits<Real>::quiet_NaN();
  const MuscleMeasures measures = measure(scene, frame_with(points));
  EXPECT_FALSE(measures.finite);
  EXPECT_THAT(missed_gates(measures, {}), testing::ElementsAre(testing::HasSubstr("not finite")));
}

TEST(Measurer, remembering_where_points_were_changes_no_number) {
  const Scene scene = ball_beside_a_box();
  Measurer remembering(scene);
  std::mt19937 generator(4);
  std::uniform_real_distribution<Real> uniform(-1, 1);
  Points points = scene.muscles[0].surface.vertices;
  int frames_inside = 0;
  for (int i = 0; i < 60; ++i) {
    // To and fro, now by little and now by a jump, with the bone turning.
    for (Real& x : points.reshaped()) x += 0.0005 * uniform(generator);
    points.row(0).array() += i % 13 == 0 ? 0.02 * uniform(generator) : -0.0008;
    const RigidTransform bone = Eigen::Translation3d(0.01 * std::sin(0.4 * i), 0, 0) *
                                Eigen::AngleAxisd(0.2 * std::sin(0.3 * i), Vec3::UnitZ());
    const Frame frame = frame_with(points, bone);
    const MuscleMeasures fresh = measure(scene, frame);
    EXPECT_TRUE(equal(remembering.measure(frame).at(0), fresh)) << "frame " << i;
    frames_inside += fresh.vertex_depth > 0;
  }
  EXPECT_GT(frames_inside, 5);
  EXPECT_LT(frames_inside, 60);
}

TEST(Measurer, what_muscles_overlap_by_at_rest_is_forgiven_around_it_alone) {
  Scene scene = ball_beside_a_box();
  scene.method.name = "xpbd";
  scene.muscles.push_back(scene.muscles.front());
  scene.muscles[0].surface = shapes::sphere({0, 0, 0.06}, 0.02, 3);
  scene.muscles[1].name = "long";
  scene.muscles[1].surface = shapes::sphere(Vec3::Zero(), 0.02, 4);
  scene.muscles[1].surface.vertices.row(2) *= 6;              // 24 cm from end to end
  scene.muscles[0].surface.vertices.row(0).array() += 0.033;  // 4 mm in it
  Frame frame;
  frame.pose = pose_with(RigidTransform::Identity());
  for (const Muscle& muscle : scene.muscles) frame.muscles.push_back({muscle.surface.vertices});
  Measurer measurer(scene);
  EXPECT_EQ(measurer.measure(frame)[1].muscle_depth_beyond_rest, 0);
  frame.muscles[0].points.row(2).array() -= 0.01;
  EXPECT_LT(measurer.measure(frame)[1].muscle_depth_beyond_rest, 1e-3) << "slid along by 1 cm, a little deeper";
  frame.muscles[0].points.row(2).array() -= 0.11;
  EXPECT_GT(measurer.measure(frame)[1].muscle_depth_beyond_rest, 3e-3) << "as deep as at rest, at the other end";
  EXPECT_EQ(measurer.measure(frame)[1].deepest_in, scene.muscles[0].name);
}

TEST(Measurer, says_which_muscle_a_vertex_lies_deepest_in_where_the_method_keeps_them_apart) {
  Scene scene = ball_beside_a_box();
  for (const Real x : {0.12, 0.165}) {
    Muscle next = scene.muscles.front();
    next.name = x < 0.15 ? "second" : "third";
    next.surface = shapes::sphere({x, 0, 0}, 0.02, 2);
    scene.muscles.push_back(next);
  }
  Frame frame;
  frame.pose = pose_with(RigidTransform::Identity());
  for (const Muscle& muscle : scene.muscles) frame.muscles.push_back({muscle.surface.vertices});
  frame.muscles[1].points.row(0).array() -= 0.01;  // of the 5 mm between them 10 are gone
  for (const auto& [method, measured] : {std::pair("xpbd", true), {"tissue", true}, {"skinning", false}}) {
    scene.method.name = method;
    const std::vector<MuscleMeasures> all = Measurer(scene).measure(frame);
    EXPECT_EQ(all[0].deepest_in, measured ? "second" : "") << method;
    EXPECT_EQ(all[1].deepest_in, measured ? "ball" : "") << method;
    EXPECT_EQ(all[2].deepest_in, "") << method;
    EXPECT_NEAR(all[1].muscle_depth_beyond_rest, measured ? 0.005 : 0, 5e-4) << method;
    EXPECT_EQ(all[2].muscle_depth_beyond_rest, 0) << method;
  }
  scene.method = {.name = "tissue", .settings = {{"contact_rounds", 0}}};
  EXPECT_EQ(Measurer(scene).measure(frame)[1].deepest_in, "") << "muscles that do not look at each other";
}

TEST(QualityGates, say_what_was_missed_with_number_and_limit) {
  MuscleMeasures measures;
  EXPECT_THAT(missed_gates(measures, {}), testing::IsEmpty());
  measures.volume_ratio = 0.99;
  measures.vertex_depth_beyond_rest = 0.00034;
  measures.midpoint_depth_beyond_rest = 0.0007;
  measures.muscle_depth_beyond_rest = 0.0013;
  measures.deepest_in = "psoas_r";
  measures.edge_ratio_max_free = 4.2;
  measures.belly_off_place = 0.0184;
  measures.wrong_side = 0.25;
  measures.slack = 0.163;
  EXPECT_THAT(
      missed_gates(measures, {}),
      testing::ElementsAre(testing::HasSubstr("99.00 %"), testing::HasSubstr("0.340 mm"),
                           testing::HasSubstr("0.700 mm"), testing::HasSubstr("another muscle (psoas_r) 1.300 mm"),
                           testing::HasSubstr("4.2 times"), testing::HasSubstr("18.4 mm off its place"),
                           testing::HasSubstr("25 %"), testing::HasSubstr("16 % longer")));
  measures = {};
  measures.volume_ratio = 1.0051;
  EXPECT_EQ(missed_gates(measures, {}).size(), 1u);
  measures.volume_ratio = 1.0049;
  EXPECT_THAT(missed_gates(measures, {}), testing::IsEmpty());
}

}  // namespace gracilis
