#include <gracilis/io/scene/scene_reader.hpp>

#include "io/scene_reader_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace gracilis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A muscle of strips from end to end between the two bones, `sides` around it, in millimetres.
void write_needles(const SceneFolder& folder, int sides) {
  const TriangleMesh mesh = shapes::cylinder(4, 18, sides, 1);
  std::ostringstream text;
  text << "ply\nformat ascii 1.0\nelement vertex " << mesh.vertex_count()
       << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << mesh.face_count()
       << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const auto v : mesh.vertices.colwise()) text << 5 + v.x() << ' ' << 5 + v.y() << ' ' << 11 + v.z() << '\n';
  for (const auto f : mesh.faces.colwise()) text << "3 " << f[0] << ' ' << f[1] << ' ' << f[2] << '\n';
  folder.write("muscle.ply", text.str());
}

}  // namespace

TEST_F(SceneReader, lengths_become_metres_and_angles_radians) {
  const Scene scene = read(good_scene()).scene;
  EXPECT_THAT(scene.bodies, ElementsAre("pelvis", "femur"));
  EXPECT_NEAR(scene.bones[1].surface.vertices.row(2).maxCoeff(), 0.010, 1e-9);
  ASSERT_EQ(scene.joints.size(), 1u);
  EXPECT_NEAR((scene.joints[0].frame.translation() - Vec3(0.005, 0.005, 0.020)).norm(), 0, 1e-12);
  EXPECT_NEAR(scene.joints[0].axes[0].capture_value, radians(2), 1e-15);
  EXPECT_NEAR(scene.joints[0].axes[0].range_max, radians(20), 1e-15);
  EXPECT_NEAR(scene.motion.values(10, 0), radians(10), 1e-15);
}

TEST_F(SceneReader, divides_needles_unless_they_are_to_stay_and_says_so) {
  write_needles(folder, 60);
  const std::string kept = good_scene() + "[surfaces]\ndivide_needles = false\n";
  const TriangleMesh raw = read(kept).scene.muscles.at(0).surface;
  EXPECT_THAT(read(kept).warnings, testing::Each(testing::Not(HasSubstr("triangles were divided"))));
  const LoadedScene loaded = read(good_scene());
  EXPECT_THAT(loaded.warnings, testing::Contains(HasSubstr("divided in the surfaces of 1 of 1 muscles")));
  const TriangleMesh& surface = loaded.scene.muscles.at(0).surface;
  EXPECT_GT(surface.vertex_count(), raw.vertex_count());
  EXPECT_EQ(surface.vertices.leftCols(raw.vertex_count()), raw.vertices);
}

TEST_F(SceneReader, holds_what_comes_between_listed_vertices_when_needles_are_divided) {
  write_needles(folder, 60);
  const std::string below =
      with(good_scene(), "bone = \"femur\"\nbone_distance_mm = 2", "body = \"femur\"\nvertices = [30]");
  const auto listing = [&](const std::string& vertices) {
    return with(below, "bone = \"pelvis\"\nbone_distance_mm = 2", "body = \"pelvis\"\nvertices = [" + vertices + "]");
  };
  // Some of the lower end, and those above them.
  EXPECT_GT(read(listing("0, 1, 2, 3, 60, 61, 62, 63")).scene.muscles.at(0).attachments.at(0).vertices.size(), 8u);
  EXPECT_THAT(problems(listing("0, 122")), HasSubstr("vertex 122 does not exist (the surface has vertices 0 to 121)"));
}

TEST_F(SceneReader, holds_what_comes_between_vertices_that_a_cloud_names_when_needles_are_divided) {
  write_needles(folder, 60);
  const TriangleMesh of_file = shapes::cylinder(4, 18, 60, 1);
  std::string points;
  for (const Index v : {0, 1, 2, 3, 60, 61, 62, 63}) {
    const Vec3 p = of_file.vertices.col(v) + Vec3(5, 5, 11);
    points += (points.empty() ? "[" : ", [") + std::to_string(p.x()) + ", " + std::to_string(p.y()) + ", " +
              std::to_string(p.z()) + "]";
  }
  const std::string below =
      with(good_scene(), "bone = \"femur\"\nbone_distance_mm = 2", "body = \"femur\"\nvertices = [30]");
  const auto attached = [&](const std::string& how) {
    const std::string scene = with(below, "bone = \"pelvis\"\nbone_distance_mm = 2", how);
    return read(scene).scene.muscles.at(0).attachments.at(0).vertices;
  };
  const std::vector<Index> listed = attached("body = \"pelvis\"\nvertices = [0, 1, 2, 3, 60, 61, 62, 63]");
  ASSERT_GT(listed.size(), 8u);
  EXPECT_EQ(attached("body = \"pelvis\"\npoints_mm = [" + points + "]\nlandmark_distance_mm = 0.001"), listed);
  EXPECT_EQ(
      attached("bone = \"pelvis\"\nbone_distance_mm = 100\npoints_mm = [" + points + "]\nlandmark_distance_mm = 0.001"),
      listed);
}

TEST_F(SceneReader, attachments_by_distance_to_a_bone_take_the_vertices_that_face_it) {
  const Muscle muscle = read(good_scene()).scene.muscles.at(0);
  ASSERT_EQ(muscle.attachments.size(), 2u);
  EXPECT_THAT(muscle.attachments[0].vertices, ElementsAre(4, 5, 6, 7));
  EXPECT_THAT(muscle.attachments[1].vertices, ElementsAre(0, 1, 2, 3));
  EXPECT_EQ(muscle.attachments[0].body, 0);
  EXPECT_EQ(muscle.attachments[1].body, 1);
}

TEST_F(SceneReader, key_poses_are_joined_by_steps_of_one_degree) {
  const Scene scene = read(with(good_scene(), "[[0], [10]]", "[[0], [10], [7.5]]")).scene;
  ASSERT_EQ(scene.motion.times.size(), 1u + 10u + 3u);
  EXPECT_NEAR(degrees(scene.motion.values(3, 0)), 3, 1e-12);
  EXPECT_NEAR(degrees(scene.motion.values(11, 0)), 10 - 2.5 / 3, 1e-12);
  EXPECT_NEAR(scene.motion.times[6], 0.1, 1e-12);
}

TEST_F(SceneReader, every_file_that_was_read_is_listed_for_the_manifest) {
  const LoadedScene loaded = read(good_scene());
  std::vector<std::string> names;
  for (const auto& input : loaded.inputs) names.push_back(input.filename());
  EXPECT_THAT(names, ElementsAre("scene.toml", "pelvis.ply", "femur.ply", "muscle.ply"));
}

TEST_F(SceneReader, joints_are_sorted_parents_first) {
  std::string text = with(good_scene(), "[[joints]]", R"([[joints]]
name = "knee"
parent = "femur"
child = "tibia"
center = [0, 0, 0]
[[joints]])");
  const Scene scene = read(text).scene;
  EXPECT_THAT(scene.bodies, ElementsAre("pelvis", "femur", "tibia"));
  EXPECT_EQ(scene.joints[0].name, "hip");
  EXPECT_EQ(scene.joints[1].name, "knee");
}

TEST_F(SceneReader, the_orientation_is_body_fixed_x_y_z) {
  const Scene scene =
      read(with(good_scene(), "[[joints.axes]]", "orientation_xyz_rad = [0.1, 0.2, 0.3]\n[[joints.axes]]")).scene;
  const Eigen::Matrix3d expected = (Eigen::AngleAxisd(0.1, Vec3::UnitX()) * Eigen::AngleAxisd(0.2, Vec3::UnitY()) *
                                    Eigen::AngleAxisd(0.3, Vec3::UnitZ()))
                                       .toRotationMatrix();
  EXPECT_TRUE(scene.joints[0].frame.linear().isApprox(expected, 1e-14));
}

TEST_F(SceneReader, landmarks_and_explicit_vertices_make_attachments_too) {
  folder.write("landmarks.csv", "cloud,index,x_mm,y_mm,z_mm\nline,1,0,0,30\nline,0,0,10,30\nother,1,9,9,9\n");
  std::string text = with(good_scene(), "bone_distance_mm = 2",
                          "cloud = \"line\"\nline = \"open\"\nbone_distance_mm = 2\nlandmark_distance_mm = 2");
  text = with(text, "bone = \"femur\"\nbone_distance_mm = 2", "body = \"femur\"\nvertices = [3, 1]\nguessed = true");
  text = with(text, "[[bones]]", "[landmarks]\nfile = \"landmarks.csv\"\nunit = \"mm\"\n[[bones]]");
  const Muscle muscle = read(text).scene.muscles.at(0);
  EXPECT_THAT(muscle.attachments[0].vertices, ElementsAre(4, 6)) << "the edge x = 0 of the muscle's top";
  EXPECT_THAT(muscle.attachments[1].vertices, ElementsAre(1, 3));
  EXPECT_TRUE(muscle.attachments[1].guessed);
}

TEST_F(SceneReader, an_outline_needs_the_bone_that_its_inside_lies_on) {
  const std::string text = with(good_scene(), "bone = \"pelvis\"\nbone_distance_mm = 2",
                                "body = \"pelvis\"\nline = \"outline\"\npoints_mm = [[0, 0, 30], [10, 10, 30], [0, 10, "
                                "30]]\nlandmark_distance_mm = 2");
  try {
    read(text);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("has an outline but no bone"));
  }
}

TEST_F(SceneReader, points_without_a_bone_make_an_attachment) {
  const std::string text = with(good_scene(), "bone = \"pelvis\"\nbone_distance_mm = 2",
                                "body = \"pelvis\"\npoints_mm = [[0, 0, 30], [10, 10, 33]]\nlandmark_distance_mm = 2");
  EXPECT_THAT(read(text).scene.muscles[0].attachments[0].vertices, ElementsAre(4));
}

TEST_F(SceneReader, a_motion_file_is_matched_by_name_and_followed_row_by_row) {
  folder.write("walk.mot",
               "walk\nversion=1\nnRows=3\nnColumns=4\ninDegrees=yes\nendheader\n"
               "time\tpelvis_tilt\tflexion\tpelvis_tx\n0\t1\t5\t0\n0.5\t1\t6\t0\n1\t1\t7\t0\n");
  const std::string by_keys = "coordinates = [\"flexion\"]\nkey_poses_deg = [[0], [10]]";
  const Motion motion = read(with(good_scene(), by_keys, "file = \"walk.mot\"")).scene.motion;
  EXPECT_THAT(motion.coordinates, ElementsAre("flexion"));
  ASSERT_EQ(motion.times.size(), 3u);
  EXPECT_NEAR(degrees(motion.values(2, 0)), 7, 1e-12);
  EXPECT_EQ(motion.times[1], 0.5);
}

TEST_F(SceneReader, a_motion_file_without_any_of_the_scenes_coordinates_is_the_wrong_file) {
  folder.write("walk.mot", "walk\nversion=1\nnRows=1\nnColumns=2\ninDegrees=yes\nendheader\ntime\tknee\n0\t1\n");
  const std::string by_keys = "coordinates = [\"flexion\"]\nkey_poses_deg = [[0], [10]]";
  EXPECT_THAT(problems(with(good_scene(), by_keys, "file = \"walk.mot\"")),
              HasSubstr("walk.mot: none of its columns is a coordinate of the scene (known are 'flexion')"));
  EXPECT_EQ(code, ExitCode::unreadable_input);
  EXPECT_THAT(problems(with(good_scene(), by_keys, "file = \"walk.mot\"\ncoordinates = [\"flexion\"]")),
              HasSubstr("walk.mot: has no column 'flexion'"));
}

TEST_F(SceneReader, a_motion_given_twice_or_not_at_all_is_an_error) {
  const std::string keys = "key_poses_deg = [[0], [10]]\n";
  EXPECT_THAT(problems(with(good_scene(), keys, keys + "file = \"a.mot\"\n")), HasSubstr("the motion is given twice"));
  EXPECT_THAT(problems(with(good_scene(), keys, "")),
              HasSubstr("[motion] needs the key 'file' or the key 'key_poses_deg'"));
  EXPECT_THAT(problems(with(good_scene(), "coordinates = [\"flexion\"]\n", "")),
              HasSubstr("'key_poses_deg' needs the key 'coordinates'"));
}

TEST_F(SceneReader, a_box_needs_no_file_and_a_press_moves_it_in_millimetres) {
  const std::string text = R"(schema = 1
[[bones]]
name = "plate"
body = "press"
box = { size_mm = [20, 20, 2], center_mm = [0, 0, 10] }
[[joints]]
name = "press"
parent = "ground"
child = "press"
center = [0, 0, 0]
[[joints.axes]]
coordinate = "press_tz"
axis = [0, 0, 1]
translation = true
range_mm = [-5, 0]
[[muscles]]
name = "box"
box = { size_mm = [10, 10, 10], cells = [2, 2, 2] }
[motion]
coordinates = ["press_tz"]
)";
  const Scene scene = read_scene(folder.write("scene.toml", text + "key_poses_mm = [[0], [-4]]\nstep_mm = 2\n")).scene;
  EXPECT_EQ(scene.muscles[0].surface.face_count(), 48);
  EXPECT_TRUE(scene.muscles[0].attachments.empty());
  EXPECT_NEAR(scene.bones[0].surface.vertices.row(2).minCoeff(), 0.009, 1e-12);
  ASSERT_EQ(scene.motion.values.rows(), 3);
  EXPECT_NEAR(scene.motion.values(2, 0), -0.004, 1e-12);
  EXPECT_NEAR(scene.joints[0].axes[0].range_min, -0.005, 1e-12);
  EXPECT_THROW(read_scene(folder.write("wrong.toml", text + "key_poses_deg = [[0], [-4]]\n")), ConfigurationError);
}

TEST_F(SceneReader, a_motion_beyond_the_range_is_warned_about_and_followed) {
  const LoadedScene loaded = read(with(good_scene(), "[[0], [10]]", "[[0], [35]]"));
  EXPECT_THAT(
      loaded.warnings,
      testing::Contains(HasSubstr("takes flexion from 0 to 35 degrees, beyond the model's range of -10 to 20")));
  EXPECT_NEAR(degrees(loaded.scene.motion.values.maxCoeff()), 35, 1e-12);
}

TEST_F(SceneReader, a_motion_far_beyond_the_range_is_told_in_few_digits) {
  const LoadedScene loaded = read(with(good_scene(), "range_deg = [-10, 20]", "range_deg = [-1e300, -2e15]"));
  EXPECT_THAT(loaded.warnings, testing::Contains(HasSubstr("beyond the model's range of -1e+300 to -2e+15;")));
}

TEST_F(SceneReader, a_joint_whose_center_is_in_another_unit_is_warned_about) {
  EXPECT_THAT(read(good_scene()).warnings, testing::Each(testing::Not(HasSubstr("its center is"))));
  const LoadedScene loaded = read(with(good_scene(), "center_unit = \"mm\"", "center_unit = \"m\""));
  EXPECT_THAT(loaded.warnings, testing::Contains(HasSubstr("joint 'hip': its center is 21.17 m from the bones of "
                                                           "'pelvis' and 'femur'")));
}

TEST_F(SceneReader, a_handful_of_vertices_is_warned_about) {
  EXPECT_THAT(read(good_scene()).warnings,
              testing::Contains(HasSubstr("'top' of muscle is held by a handful of vertices (4)")));
}

}  // namespace gracilis
