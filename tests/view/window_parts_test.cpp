#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/io/scene/demo_scene.hpp>
#include <gracilis/view/window/arrows.hpp>
#include <gracilis/view/window/bone_pull.hpp>
#include <gracilis/view/window/bone_slice.hpp>
#include <gracilis/view/window/contact_depth.hpp>
#include <gracilis/view/window/frame_maker.hpp>
#include <gracilis/view/window/picking.hpp>
#include <gracilis/view/window/player.hpp>
#include <gracilis/view/window/shape_history.hpp>
#include <gracilis/view/window/slider_range.hpp>

#include <gracilis/geometry/measures.hpp>

#include <gtest/gtest.h>
#include <shapes.hpp>

using namespace gracilis;

static ShownFrame captioned(const std::string& caption) {
  ShownFrame frame;
  frame.caption = caption;
  return frame;
}

TEST(SliderRange, is_the_coordinates_within_120_degrees_or_100_millimetres_and_has_the_capture_pose) {
  using Range = std::pair<Real, Real>;
  JointAxis axis;
  EXPECT_EQ(slider_range(axis), Range(-radians(120), radians(120)));
  axis.range_min = -0.2, axis.range_max = 1;
  EXPECT_EQ(slider_range(axis), Range(-0.2, 1));
  axis.capture_value = 3;
  EXPECT_EQ(slider_range(axis), Range(-0.2, 3));
  axis.capture_value = 0, axis.translation = true;
  EXPECT_EQ(slider_range(axis), Range(-0.1, 0.1));
}

TEST(ShapeHistory, keeps_the_last_frames_under_their_numbers) {
  ShapeHistory history(3);
  for (int i = 0; i < 5; ++i) history.append(captioned(std::to_string(i)));
  EXPECT_EQ(history.begin(), 2);
  EXPECT_EQ(history.end(), 5);
  EXPECT_EQ(history.at(3)->caption, "3");
  EXPECT_EQ(history.at(0)->caption, "2");
  EXPECT_EQ(history.at(99)->caption, "4");
}

TEST(ShapeHistory, replaces_only_what_is_kept) {
  ShapeHistory history(2);
  for (int i = 0; i < 4; ++i) history.append(captioned(std::to_string(i)));
  history.replace(3, captioned("new"));
  history.replace(1, captioned("lost"));
  history.replace(7, captioned("early"));
  EXPECT_EQ(history.at(3)->caption, "new");
  EXPECT_EQ(history.at(2)->caption, "2");
  EXPECT_EQ(history.end(), 4);
}

TEST(ShapeHistory, forgets_passes_and_nothing_else) {
  ShapeHistory history;
  ShownFrame frame = captioned("a");
  frame.passes.resize(4);
  history.append(std::move(frame));
  history.forget_passes(-1);
  EXPECT_EQ(history.at(0)->passes.size(), 4u);
  history.forget_passes(0);
  EXPECT_TRUE(history.at(0)->passes.empty());
  EXPECT_EQ(history.at(0)->caption, "a");
}

TEST(Player, shows_each_frame_when_its_time_has_come) {
  Player player;
  player.speed = 1;
  player.play(true, 10.0);
  EXPECT_FALSE(player.advance(10.01, 0, 100));
  EXPECT_TRUE(player.advance(10.02, 0, 100));
  EXPECT_EQ(player.frame, 1);
  EXPECT_TRUE(player.advance(10.51, 0, 100));  // a slow picture skips frames
  EXPECT_EQ(player.frame, 30);
}

TEST(Player, begins_again_or_stops_at_the_end) {
  Player player;
  player.speed = 1;
  player.frame = 9;
  player.play(true, 0);
  player.advance(0.05, 0, 10);
  EXPECT_EQ(player.frame, 2);
  EXPECT_TRUE(player.playing);
  player.loops = false;
  player.advance(1, 0, 10);
  EXPECT_EQ(player.frame, 9);
  EXPECT_FALSE(player.playing);
}

TEST(Player, jumps_within_what_there_is_and_stops) {
  Player player;
  player.play(true, 0);
  player.jump(1000, 5, 20);
  EXPECT_EQ(player.frame, 19);
  EXPECT_FALSE(player.playing);
  player.jump(-3, 5, 20);
  EXPECT_EQ(player.frame, 5);
}

TEST(ContactDepth, is_measured_against_bones_where_they_are_and_against_other_muscles) {
  const ContactDepth depth({shapes::sphere(Vec3::Zero(), 0.05, 5)});
  const TriangleMesh first = shapes::sphere(Vec3(0.068, 0, 0), 0.02, 4),
                     second = shapes::sphere(Vec3(0.107, 0, 0), 0.02, 4);
  const auto nearest = [](const TriangleMesh& mesh, const Vec3& p) {
    Index v = 0;
    (mesh.vertices.colwise() - p).colwise().squaredNorm().minCoeff(&v);
    return v;
  };
  // 2 mm in the bone, 1 mm in the other muscle, and far from all.
  const std::vector<std::vector<Index>> vertices = {
      {nearest(first, Vec3(0, 0, 0)), nearest(first, Vec3(1, 0, 0)), nearest(first, Vec3(0.068, 1, 0))},
      {nearest(second, Vec3(0, 0, 0))}};
  const auto depths = depth.of({first, second}, vertices, {RigidTransform::Identity()});
  EXPECT_NEAR(depths[0][0], 0.002, 1e-4);
  EXPECT_NEAR(depths[0][1], 0.001, 1e-4);
  EXPECT_NEAR(depths[0][2], -0.003, 1e-6);
  EXPECT_NEAR(depths[1][0], 0.001, 1e-4);
  const RigidTransform away(Eigen::Translation3d(-0.001, 0, 0));
  EXPECT_NEAR(depth.of({first, second}, vertices, {away})[0][0], 0.001, 1e-4);
}

TEST(FrameMaker, thins_surfaces_and_measures_the_whole_ones) {
  ShownShapes shapes;
  shapes.muscles = {"a"};
  shapes.bones = {"b"};
  const TriangleMesh muscle = shapes::sphere(Vec3::Zero(), 0.05, 6), bone = shapes::sphere(Vec3::Zero(), 0.02, 3);
  ASSERT_GT(muscle.vertex_count(), 12000);
  FrameMaker maker({muscle}, {bone}, shapes);
  ShownFrame frame;
  maker.fill({1.1 * muscle.vertices}, {RigidTransform::Identity()}, false, frame);
  EXPECT_LE(frame.muscles[0].cols(), 13000);
  EXPECT_GT(frame.muscles[0].cols(), 8000);
  EXPECT_EQ(shapes.muscle_faces[0].maxCoeff(), frame.muscles[0].cols() - 1);
  EXPECT_NEAR(frame.volume[0], 1.331, 1e-9);
  for (const float stretch : frame.stretch[0]) EXPECT_NEAR(stretch, 1.1, 1e-5);
  EXPECT_TRUE(frame.contact_depth.empty());
  maker.fill_stress({Eigen::VectorXd(muscle.vertices.row(0))}, frame);
  ASSERT_EQ(static_cast<Index>(frame.stress[0].size()), frame.muscles[0].cols());
  for (std::size_t v = 0; v < frame.stress[0].size(); ++v)
    EXPECT_NEAR(1.1 * frame.stress[0][v], frame.muscles[0](0, static_cast<Index>(v)), 1e-6);
}

TEST(FrameMaker, shows_the_tensions_of_the_fibers_that_it_shows) {
  std::vector<Points> lines;
  for (Index i = 0; i < 100; ++i) lines.push_back(Points::Constant(3, 2, i));
  ShownShapes shapes;
  shapes.muscles = {"a"};
  FrameMaker maker({shapes::sphere(Vec3::Zero(), 1, 2)}, {}, shapes);
  ShownFrame frame;
  maker.fill_fibers({join(lines)}, frame);
  FrameMaker::fill_tension({Eigen::VectorXd::LinSpaced(100, 0, 99)}, frame);
  ASSERT_EQ(static_cast<Index>(frame.tension[0].size()), frame.fibers[0].count());
  for (Index i = 0; i < frame.fibers[0].count(); ++i)
    EXPECT_EQ(frame.tension[0][static_cast<std::size_t>(i)], frame.fibers[0].line(i)(0, 0));
}

TEST(FrameMaker, spreads_arrows_evenly) {
  ShownShapes shapes;
  shapes.muscles = {"a"};
  FrameMaker maker({shapes::sphere(Vec3::Zero(), 1, 4)}, {}, shapes);
  ASSERT_EQ(shapes.arrow_roots[0].size(), 350u);
  const TriangleMesh muscle = shapes::sphere(Vec3::Zero(), 1, 4);
  Real nearest = 10;
  for (const Index a : maker.arrow_vertices(0))
    for (const Index b : maker.arrow_vertices(0))
      if (a != b) nearest = std::min(nearest, (muscle.vertices.col(a) - muscle.vertices.col(b)).norm());
  EXPECT_GT(nearest, 0.1);  // 350 disks of this diameter cover a fifth of the sphere
}

/// Two passes of one muscle: distances move its only root up in iteration 0, contact down in iteration 1.
struct Arrowed {
  ShownShapes shapes;
  ShownFrame frame;
  WindowState state;

  Arrowed() {
    shapes.muscles = {"a"};
    shapes.arrow_roots = {{0}};
    frame.muscles = {ShownPoints::Zero(3, 1)};
    const auto pass = [](ConstraintKind kind, int iteration, float z) {
      ShownPass result{0, name_of(kind), iteration, ShownPoints::Zero(3, 1)};
      result.moved(2, 0) = z;
      return result;
    };
    frame.passes = {pass(ConstraintKind::distance, 0, 1e-3f), pass(ConstraintKind::distance, 1, 2e-3f),
                    pass(ConstraintKind::bone_contact, 1, -1e-3f)};
    state.muscles = {MuscleState::solid};
    state.arrow_kinds.assign(static_cast<std::size_t>(ConstraintKind::bone_contact) + 1, true);
  }
};

TEST(Arrows, sum_up_a_frame_by_kind) {
  Arrowed arrowed;
  EXPECT_TRUE(displacements_of(arrowed.shapes, arrowed.frame, arrowed.state).empty());
  arrowed.state.arrows = Arrows::frame;
  const auto found = displacements_of(arrowed.shapes, arrowed.frame, arrowed.state);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].kind, ConstraintKind::distance);
  EXPECT_NEAR(found[0].moved.z(), 3e-3, 1e-9);
  EXPECT_NEAR(found[1].moved.z(), -1e-3, 1e-9);
}

TEST(Arrows, show_one_iteration_and_the_kinds_that_are_chosen) {
  Arrowed arrowed;
  EXPECT_EQ(iteration_count(arrowed.frame), 2);
  arrowed.state.arrows = Arrows::iteration;
  arrowed.state.iteration = 1;
  EXPECT_EQ(displacements_of(arrowed.shapes, arrowed.frame, arrowed.state).size(), 2u);
  arrowed.state.arrow_kinds[static_cast<std::size_t>(ConstraintKind::distance)] = false;
  EXPECT_EQ(displacements_of(arrowed.shapes, arrowed.frame, arrowed.state).size(), 1u);
  arrowed.state.muscles = {MuscleState::hidden};
  EXPECT_TRUE(displacements_of(arrowed.shapes, arrowed.frame, arrowed.state).empty());
}

TEST(Arrows, are_scaled_by_round_factors) {
  const auto of = [](float length) {
    return std::vector<Displacement>(10,
                                     {Eigen::Vector3f::Zero(), Eigen::Vector3f(0, length, 0), ConstraintKind::volume});
  };
  EXPECT_NEAR(arrow_scale(of(0.015f)), 1, 1e-9);
  EXPECT_NEAR(arrow_scale(of(0.001f)), 10, 1e-9);
  EXPECT_NEAR(arrow_scale(of(0.0005f)), 20, 1e-9);
  EXPECT_NEAR(arrow_scale(of(0.0002f)), 50, 1e-9);
  EXPECT_EQ(arrow_scale({}), 1);
}

TEST(Arrows, end_where_the_scaled_displacement_ends) {
  const ColoredMesh mesh =
      arrow_mesh({{Eigen::Vector3f(1, 0, 0), Eigen::Vector3f(0, 0, 1e-3f), ConstraintKind::volume},
                  {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(0, 0, 1e-6f), ConstraintKind::volume}},
                 10);
  float top = -1;
  for (const Eigen::Vector3f& point : mesh.points) {
    top = std::max(top, point.z());
    EXPECT_NEAR(point.x(), 1, 0.01);
  }
  EXPECT_NEAR(top, 0.01, 1e-6);
}

TEST(Glyphs, dots_are_closed_and_oriented_outwards) {
  ColoredMesh mesh;
  append_dot(Eigen::Vector3f(1, 2, 3), 0.5f, Color::Ones(), mesh);
  Points points(3, 6);
  Eigen::Matrix3Xi faces(3, static_cast<Index>(mesh.faces.size()));
  for (int i = 0; i < 6; ++i) points.col(i) = mesh.points[static_cast<std::size_t>(i)].cast<Real>();
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) faces.col(static_cast<Index>(f)) = mesh.faces[f];
  EXPECT_NEAR(enclosed_volume(points, faces), 4.0 / 3 * 0.125, 1e-6);
}

TEST(BoneSlice, is_dark_at_the_surface_red_inside_and_ends_where_bones_are_far) {
  ShownShapes shapes;
  const TriangleMesh bone = shapes::sphere(Vec3::Zero(), 0.04, 4);
  shapes.bones = {"b"};
  shapes.bone_points = {bone.vertices.cast<float>()};
  ShownFrame frame;
  frame.bones = {RigidTransform(Eigen::Translation3d(0.1, 0, 0))};
  const std::vector<DistanceField> fields = {build_distance_field(bone, domain_by_cell_size(bone, 0.002, 0.02))};
  const ColoredMesh slice = bone_slice(shapes, frame, fields, Slice::transverse, 0.5);
  ASSERT_FALSE(slice.faces.empty());
  int dark = 0, red = 0;
  for (std::size_t i = 0; i < slice.points.size(); ++i) {
    const Real distance = (slice.points[i].cast<Real>() - Vec3(0.1, 0, 0)).norm() - 0.04;
    EXPECT_NEAR(slice.points[i].y(), 0, 1e-3);
    if (slice.colors[i].maxCoeff() < 0.2) {
      ++dark;
      EXPECT_LT(std::abs(distance), 0.0012);
    }
    if (distance < -0.008) {
      ++red;
      EXPECT_GT(slice.colors[i].x(), slice.colors[i].z());
    }
  }
  EXPECT_GT(dark, 50);
  EXPECT_GT(red, 200);
  EXPECT_TRUE(bone_slice(shapes, frame, fields, Slice::none, 0.5).faces.empty());
  EXPECT_TRUE(bone_slice(shapes, frame, {}, Slice::transverse, 0.5).faces.empty());
}

TEST(BonePull, turns_the_joint_so_that_the_grabbed_point_follows_the_mouse) {
  const Scene scene = demo_scene("hip");
  const std::vector<std::string> names = coordinate_names(scene);
  const auto flexion = static_cast<std::size_t>(std::find(names.begin(), names.end(), "hip_flexion_r") - names.begin());
  const auto femur = static_cast<std::size_t>(
      std::find_if(scene.bones.begin(), scene.bones.end(), [](const Bone& bone) { return bone.name == "femur_r"; }) -
      scene.bones.begin());
  const auto body = static_cast<std::size_t>(scene.bones[femur].body);
  std::vector<Real> aimed = capture_coordinates(scene);
  const Vec3 point = scene.bones[femur].surface.vertices.rowwise().mean();
  const auto place = [&](const std::vector<Real>& values) -> Vec3 {
    return pose_at(scene, values).bodies[body] * point;
  };
  std::vector<Real> wanted = aimed;
  wanted[flexion] += radians(35);
  const Vec3 looking = scene.axes.right();
  EXPECT_TRUE(pull_bone(scene, femur, point, place(wanted) + 0.3 * looking, looking, aimed));
  EXPECT_NEAR(degrees(aimed[flexion] - wanted[flexion]), 0, 0.5);
  const Vec3 off = place(aimed) - place(wanted);
  EXPECT_LT((off - off.dot(looking) * looking).norm(), 0.002) << "as seen";
  EXPECT_TRUE(pull_bone(scene, femur, point, point + Vec3(0, 5, 0), looking, aimed)) << "far beyond what it reaches";
  std::size_t number = 0;
  for (const Joint& joint : scene.joints)
    for (const JointAxis& axis : joint.axes) {
      EXPECT_GE(aimed[number], axis.range_min);
      EXPECT_LE(aimed[number++], axis.range_max);
    }
  EXPECT_FALSE(pull_bone(scene, 0, point, point, looking, aimed)) << "nothing moves the pelvis";
}

TEST(Picking, finds_what_is_seen_and_tells_its_numbers) {
  const TriangleMesh ball = shapes::sphere({0, 0, 0}, 0.02, 2), before = shapes::sphere({0.01, 0, 0.1}, 0.02, 2);
  ShownShapes shapes;
  shapes.muscles = {"behind_r", "before_r"};
  shapes.muscle_faces = {ball.faces, before.faces};
  shapes.vertex_numbers.resize(2);
  for (Index v = 0; v < before.vertex_count(); ++v)
    for (std::vector<Index>& numbers : shapes.vertex_numbers) numbers.push_back(10 * v);
  ShownFrame frame;
  frame.muscles = {ball.vertices.cast<float>(), before.vertices.cast<float>()};
  frame.stretch.assign(2, std::vector<float>(static_cast<std::size_t>(ball.vertex_count()), 1.5f));
  WindowState state;
  state.muscles.assign(2, MuscleState::solid);
  WindowProjection projection{Eigen::Matrix3d::Identity(), Vec3::Zero(), 1000, 200, 100};  // a pixel is 1 mm
  EXPECT_LT((projection.in_world(projection.in_window(Vec3(0.01, 0.02, 0.03))) - Vec3(0.01, 0.02, 0.03)).norm(), 1e-12);

  std::optional<SurfaceHit> hit = surface_at(100, 50, shapes, frame, state, projection);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->number, 1u);
  EXPECT_NEAR(hit->place.z(), 0.1 + std::sqrt(0.02 * 0.02 - 0.01 * 0.01), 0.001);
  const std::string told = numbers_of({hit->number, hit->vertex}, shapes, frame);
  EXPECT_EQ(told.find("before r, vertex " + std::to_string(10 * hit->vertex) + "\nat "), 0u) << told;
  EXPECT_NE(told.find("edges 1.50 × rest"), std::string::npos) << told;
  EXPECT_EQ(surface_at(85, 50, shapes, frame, state, projection)->number, 0u) << "beside the one before";
  state.muscles[1] = MuscleState::hidden;
  EXPECT_EQ(surface_at(100, 50, shapes, frame, state, projection)->number, 0u);
  EXPECT_FALSE(surface_at(150, 50, shapes, frame, state, projection));
}
