#include "opensim/model_texts.hpp"

#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/anatomy/sections/line_path.hpp>
#include <gracilis/anatomy/sections/line_sections.hpp>
#include <gracilis/geometry/mesh_inspection.hpp>
#include <gracilis/geometry/polylines.hpp>
#include <gracilis/io/scene/scene_reader.hpp>
#include <gracilis/methods/cylinder/cylinder_method.hpp>
#include <gracilis/opensim/import/scene_folder.hpp>
#include <gracilis/opensim/paths/muscle_path.hpp>
#include <gracilis/scene/section_line.hpp>
#include <gracilis/scene/validate.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis::opensim {

static const char* coming_and_going =
    "<ConditionalPathPoint name=\"c\"><socket_parent_frame>/ground</socket_parent_frame><location>0.25 0.02 0.01"
    "</location><socket_coordinate>/jointset/hinge/swing</socket_coordinate><range>-0.3 0.4</range>"
    "</ConditionalPathPoint>";

/// Its x is a spline, its y two straight pieces, its z a line.
static const char* moving =
    "<MovingPathPoint name=\"p\"><socket_parent_frame>/bodyset/rod</socket_parent_frame>"
    "<socket_x_coordinate>/jointset/hinge/swing</socket_x_coordinate><x_location><SimmSpline><x>-2 -0.5 0.7 2</x>"
    "<y>0.1 0.02 0.05 0.12</y></SimmSpline></x_location>"
    "<socket_y_coordinate>/jointset/hinge/swing</socket_y_coordinate><y_location><PiecewiseLinearFunction>"
    "<x>-1 0.1 1</x><y>-0.3 -0.35 -0.32</y></PiecewiseLinearFunction></y_location>"
    "<socket_z_coordinate>/jointset/hinge/swing</socket_z_coordinate><z_location><LinearFunction><coefficients>"
    "0.01 0.02</coefficients></LinearFunction></z_location></MovingPathPoint>";

static std::string around(const std::string& object, const std::string& more = "") {
  return "<PathWrap name=\"" + object + "\"><wrap_object>" + object + "</wrap_object>" + more + "</PathWrap>";
}

/// Poses of the tests go beyond its range, where the moving point stays.
static const char* narrow_swing =
    "<Coordinate name=\"swing\"><default_value>0.2</default_value><range>-1.3 1</range></Coordinate>";

/// A pendulum in a turned frame with a muscle of each kind.
static std::string lines_model() {
  const std::string wraps =
      set("WrapObjectSet",
          "<WrapCylinder name=\"pulley\"><radius>0.08</radius><length>1</length><quadrant>+x</quadrant>"
          "<xyz_body_rotation>0.1 0.05 0</xyz_body_rotation></WrapCylinder>"
          "<WrapSphere name=\"ball\"><radius>0.07</radius></WrapSphere>"
          "<WrapEllipsoid name=\"egg\"><dimensions>0.07 0.06 0.09</dimensions><quadrant>+x</quadrant></WrapEllipsoid>"
          "<WrapTorus name=\"ring\"><inner_radius>0.02</inner_radius><outer_radius>0.06</outer_radius>"
          "<translation>0.05 -0.1 0</translation><xyz_body_rotation>1.5708 0 0</xyz_body_rotation></WrapTorus>");
  const auto line = [](const std::string& name, const std::string& between, const std::string& objects) {
    return muscle(name, point("/ground", "0.2 0.05 0") + between + point("/bodyset/rod", "0.05 -0.4 0.02"), "",
                  objects);
  };
  return document(
      set("BodySet", body("rod", wraps)) +
      set("JointSet", joint("PinJoint", "hinge", "/ground", "rod", narrow_swing, "", "0.1 0.2 0.3", "0.4 0.3 0.2")) +
      set("ForceSet", line("comes", coming_and_going, "") + line("moves", moving, "") +
                          line("pulley", "", around("pulley")) + line("ball", "", around("ball")) +
                          line("egg", coming_and_going, around("egg", "<method>midpoint</method>")) +
                          line("ring", "", around("ring") + around("pulley"))));
}

struct ImportedLines {
  explicit ImportedLines(const TestFolder& folder) : model(read_model(folder.write("m.osim", lines_model()))) {
    CoordinateMotion rest{{0}, default_coordinates(model).transpose(), {}};
    left_out = write_scene_folder(model, {folder.path(), {}, {}}, {{"rest", rest}}, {}, folder.path() / "out").left_out;
    scene = read_scene(folder.path() / "out/rest.toml", {}).scene;
    scene.method.name = "cylinder";
  }
  Model model;
  std::vector<std::string> left_out;
  Scene scene;
};

TEST(SceneLines, run_as_long_as_the_models_paths_in_every_pose) {
  const TestFolder folder;
  const ImportedLines imported(folder);
  EXPECT_THAT(imported.left_out, testing::IsEmpty());
  ASSERT_THAT(validate(imported.scene), testing::IsEmpty());
  Skeleton skeleton(imported.model);
  const Real capture = imported.model.coordinates[0].default_value;
  for (std::size_t m = 0; m < imported.scene.muscles.size(); ++m) {
    const bool wraps = !imported.scene.muscles[m].action_line.path.wraps.empty();
    Real shortest = 1e9, longest = 0;
    for (const Real swing : {-1.6, -1.2, -0.8, -0.35, -0.299, 0.0, 0.2, 0.399, 0.41, 0.9, 1.4}) {
      const Eigen::VectorXd q = Eigen::VectorXd::Constant(1, swing);
      skeleton.place(q);
      const Real length = measure_path(skeleton, imported.model.muscles[m].path, q).length;
      const Pose pose = pose_at(imported.scene, std::vector<Real>{swing});
      // Arcs are chords of 5 degrees here, which are shorter by 3e-4 of their length.
      EXPECT_NEAR(polyline_length(line_at(imported.scene.muscles[m].action_line, pose)), length, wraps ? 2e-4 : 1e-9)
          << imported.scene.muscles[m].name << " at " << swing;
      shortest = std::min(shortest, length);
      longest = std::max(longest, length);
    }
    EXPECT_GT(longest - shortest, 0.02);
    // Poses without coordinates are that of the capture.
    const Pose still = capture_pose(imported.scene.bodies.size());
    const Pose same = pose_at(imported.scene, std::vector<Real>{capture});
    EXPECT_LT(
        (line_at(imported.scene.muscles[m].action_line, still) - line_at(imported.scene.muscles[m].action_line, same))
            .norm(),
        1e-12);
  }
}

TEST(SceneLines, sections_stay_as_many_and_whole_while_points_come_and_go) {
  const TestFolder folder;
  const ImportedLines imported(folder);
  const auto method = make_cylinder_method(imported.scene);
  Frame frame;
  for (Real swing = -1.5; swing < 1.5; swing += 0.01) {
    method->advance(pose_at(imported.scene, std::vector<Real>{swing}), usual_time_step);
    method->write(frame);
    for (std::size_t m = 0; m < frame.muscles.size(); ++m) {
      const gracilis::Muscle& muscle = imported.scene.muscles[m];
      ASSERT_EQ(frame.muscles[m].points.cols(), muscle.surface.vertices.cols());
      ASSERT_TRUE(frame.muscles[m].points.allFinite());
    }
  }
  // At the capture pose the surface is the input, though arcs are finer than its sections.
  method->advance(pose_at(imported.scene, std::vector<Real>{imported.model.coordinates[0].default_value}),
                  usual_time_step);
  method->write(frame);
  for (std::size_t m = 0; m < frame.muscles.size(); ++m)
    EXPECT_LT((frame.muscles[m].points - imported.scene.muscles[m].surface.vertices).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(SceneLines, sections_are_as_far_apart_everywhere_however_near_to_each_other_the_path_s_points_lie) {
  const TestFolder folder;
  const Model model = read_model(folder.write(
      "m.osim", document(set("BodySet", body("rod")) +
                         set("JointSet", joint("PinJoint", "hinge", "/ground", "rod", coordinate("swing"))) +
                         set("ForceSet",
                             muscle("m", point("/ground", "0.1 0 0") + point("/ground", "0.1 -0.005 0") +
                                             point("/ground", "0.1 -0.01 0") + point("/bodyset/rod", "0.1 -0.4 0"))))));
  SceneFolderSettings settings;
  settings.volumes.section_distance = 0.015;
  CoordinateMotion rest{{0}, default_coordinates(model).transpose(), {}};
  write_scene_folder(model, {folder.path(), {}, {}}, {{"rest", rest}}, settings, folder.path() / "out");
  const Scene scene = read_scene(folder.path() / "out/rest.toml", {}).scene;
  const Points centers = section_line(scene.muscles[0].action_line).centers;
  ASSERT_EQ(centers.cols(), 28) << "0.4 m in parts of 15 mm at most";
  for (Eigen::Index k = 1; k < centers.cols(); ++k)
    EXPECT_NEAR((centers.col(k) - centers.col(k - 1)).norm(), 0.4 / 27, 1e-9) << k;
}

TEST(SceneLines, sections_lie_on_the_pulley_where_the_line_does) {
  const TestFolder folder;
  const ImportedLines imported(folder);
  const LineSections sections = line_sections(imported.scene.muscles[2]);
  const Pose pose = pose_at(imported.scene, std::vector<Real>{1.4});
  const Points centers = sections_at(sections, pose).centers;
  const PlacedWrap& pulley = imported.scene.muscles[2].action_line.path.wraps[0];
  const RigidTransform into = (pose.bodies[static_cast<std::size_t>(pulley.body)] * pulley.frame).inverse();
  int on = 0;
  for (const Vec3 center : centers.colwise()) {
    const Real away = (into * center).head<2>().norm();
    EXPECT_GT(away, 0.08 - 1e-4);  // chords of 5 degrees
    on += away < 0.0801;
  }
  EXPECT_GE(on, 2);
}

TEST(SceneLines, a_coordinate_that_no_axis_follows_alone_is_told_and_the_point_stays) {
  const TestFolder folder;
  const std::string curve =
      "<SpatialTransform><TransformAxis name=\"rotation1\"><coordinates>swing</coordinates><axis>0 0 1</axis>"
      "<SimmSpline><x>-1 0 1</x><y>-0.5 0 0.7</y></SimmSpline></TransformAxis></SpatialTransform>";
  const Model model = read_model(folder.write(
      "m.osim", document(set("BodySet", body("rod")) +
                         set("JointSet", joint("CustomJoint", "hinge", "/ground", "rod", coordinate("swing"), curve)) +
                         set("ForceSet",
                             muscle("m", point("/ground", "0.2 0 0") + moving + point("/bodyset/rod", "0 -0.4 0"))))));
  const std::vector<std::string> left_out =
      write_scene_folder(model, {folder.path(), {}, {}}, {}, {}, folder.path() / "out").left_out;
  ASSERT_FALSE(left_out.empty());
  EXPECT_THAT(left_out[0], testing::HasSubstr("muscle 'm', point 'p': depends on the coordinate 'swing'"));
}

}  // namespace gracilis::opensim
