#include <gracilis/io/scene/scene_reader.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/methods/xpbd/settings.hpp>

#include <gracilis/anatomy/attachments/attachments.hpp>
#include <gracilis/anatomy/pose_sequence.hpp>
#include <gracilis/io/scene/data_root.hpp>
#include <gracilis/io/scene/scene_description.hpp>
#include <gracilis/io/scene/scene_template.hpp>
#include <gracilis/scene/setting_table.hpp>

#include "io/scene_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class SceneReader : public testing::Test {
 protected:
  LoadedScene read(const std::string& text, const SceneOptions& options = {}) const {
    return read_scene(folder.write("scene.toml", text), options);
  }

  /// All problems of a scene file, with the folder's name taken out.
  std::string problems(const std::string& text, const SceneOptions& options = {}) const {
    try {
      read(text, options);
    } catch (const Error& error) {
      code = error.code();
      std::string message = error.what();
      for (std::size_t at; (at = message.find(folder.path("").string())) != std::string::npos;) {
        message.erase(at, folder.path("").string().size());
      }
      return message;
    }
    return "no problem";
  }

  SceneFolder folder;
  mutable ExitCode code = ExitCode::done;
};

}  // namespace

// ---- What a good scene becomes

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

// ---- Settings, presets, overrides

TEST_F(SceneReader, settings_are_global_and_overridden_per_muscle) {
  std::string text =
      with(good_scene(), "[[muscles.attachments]]", "[muscles.settings]\niterations = 7\n[[muscles.attachments]]");
  text += "[settings]\niterations = 5\ndensity = 1000\n";
  const Scene scene = read(text).scene;
  const XpbdSettings settings = xpbd_settings(scene, scene.muscles[0]);
  EXPECT_EQ(settings.iterations, 7);
  EXPECT_EQ(settings.density, 1000);
}

TEST_F(SceneReader, the_command_line_sets_globally_and_per_muscle) {
  const LoadedScene loaded = read(good_scene() + "[settings]\niterations = 5\n",
                                  {"",
                                   {"iterations=50", "muscle.density=999", "time_mode=dynamic", "gravity=[0, 0, -9.81]",
                                    "distance_field.cell_size=0.002", "sequence.hold_frames=3"},
                                   {}});
  EXPECT_EQ(xpbd_settings(loaded.scene, loaded.scene.muscles[0]).iterations, 50);
  EXPECT_EQ(xpbd_settings(loaded.scene, loaded.scene.muscles[0]).density, 999);
  EXPECT_EQ(xpbd_settings(loaded.scene, loaded.scene.muscles[0]).time_mode, TimeMode::dynamic);
  EXPECT_EQ(xpbd_settings(loaded.scene, loaded.scene.muscles[0]).gravity.z(), -9.81);
  EXPECT_EQ(loaded.scene.distance_fields.cell_size, 0.002);
  EXPECT_EQ(loaded.scene.sequence.hold_frames, 3);
}

TEST_F(SceneReader, the_command_line_sets_one_key_of_the_motion) {
  const Motion motion = read(good_scene(), {"", {"motion.step_deg=2.5"}, {}}).scene.motion;
  ASSERT_EQ(motion.times.size(), 5u);
  EXPECT_NEAR(motion.values(1, 0), radians(2.5), 1e-12);
  EXPECT_NEAR(motion.values(4, 0), radians(10), 1e-12);
}

TEST_F(SceneReader, a_preset_from_the_command_line_sets_aside_the_files_settings_and_says_so) {
  const LoadedScene loaded =
      read(good_scene() + "[settings]\niterations = 5\n", {"", {"density=999", "preset=thesis-2024"}, {}});
  EXPECT_EQ(loaded.preset, "thesis-2024");
  EXPECT_EQ(xpbd_settings(loaded.scene, loaded.scene.muscles[0]).iterations, 70);
  EXPECT_EQ(xpbd_settings(loaded.scene, loaded.scene.muscles[0]).density, 999)
      << "what the command line sets itself stays";
  EXPECT_EQ(loaded.scene.distance_fields.resolution, 128);
  EXPECT_THAT(loaded.warnings, testing::Contains(HasSubstr("'thesis-2024' sets aside the settings")));
}

TEST_F(SceneReader, a_preset_brings_its_method_unless_one_is_named) {
  // Keys of the top come before all tables.
  const auto on_top = [](const std::string& line) { return with(good_scene(), "schema = 1", "schema = 1\n" + line); };
  EXPECT_EQ(read(on_top("preset = \"pbd-2020\"")).scene.method.settings, find_preset("pbd-2020")->method.settings);
  EXPECT_EQ(read(on_top("preset = \"pbd-2020\"\nmethod = \"arap\"")).scene.method.name, "arap");
  const LoadedScene over = read(on_top("method = \"skinning\""), {"", {"preset=pbd-2020"}, {}});
  EXPECT_EQ(over.scene.method.name, "pbd") << "the file's method goes with its settings";
  EXPECT_EQ(read(good_scene(), {"", {"preset=pbd-2020", "method=arap"}, {}}).scene.method.name, "arap");
}

TEST_F(SceneReader, a_scene_runs_by_another_method_too_which_says_what_it_does_not_have) {
  const LoadedScene loaded =
      read(good_scene() + "[settings]\niterations = 5\ntendon_length = 0.01\n", {"", {"method=skinning"}, {}});
  EXPECT_EQ(loaded.scene.method.name, "skinning");
  EXPECT_EQ(loaded.scene.method.settings, (SettingValues{{"tendon_length", 0.01}}));
  EXPECT_THAT(loaded.warnings, testing::Contains(HasSubstr("'skinning' has no setting 'iterations'")));
  EXPECT_THAT(problems(good_scene() + "[settings]\niterations = 0\n", {"", {"method=skinning"}, {}}),
              HasSubstr("'iterations' must be an integer"));
  EXPECT_THAT(problems(good_scene(), {"", {"method=skining"}, {}}), HasSubstr("there is no method 'skining'"));
}

TEST_F(SceneReader, what_muscles_are_solved_with_together_is_the_scenes) {
  const std::string text =
      with(good_scene(), "[[muscles.attachments]]", "[muscles.settings]\nsubsteps = 3\n[[muscles.attachments]]");
  const LoadedScene loaded = read(text);
  EXPECT_EQ(loaded.scene.method.settings, (SettingValues{{"substeps", 3}}));
  EXPECT_TRUE(loaded.scene.muscles[0].settings.empty());
  EXPECT_THAT(loaded.warnings, testing::Contains(HasSubstr("'substeps' holds for all muscles together")));
}

TEST_F(SceneReader, an_included_file_is_the_base_that_the_file_builds_on) {
  folder.write("base.toml", good_scene() + "[settings]\niterations = 5\ndensity = 1000\n");
  const LoadedScene loaded = read(R"(schema = 1
include = "base.toml"
name = "variant"
[settings]
iterations = 6
[[muscles]]
name = "muscle"
settings.hinge_limit = 0.1
[motion]
coordinates = ["flexion"]
key_poses_deg = [[1]]
)");
  EXPECT_EQ(loaded.scene.name, "variant");
  ASSERT_EQ(loaded.scene.muscles.size(), 1u);
  EXPECT_EQ(xpbd_settings(loaded.scene, loaded.scene.muscles[0]).iterations, 6);
  EXPECT_EQ(xpbd_settings(loaded.scene, loaded.scene.muscles[0]).density, 1000);
  EXPECT_EQ(xpbd_settings(loaded.scene, loaded.scene.muscles[0]).hinge_limit, 0.1);
  EXPECT_EQ(loaded.scene.motion.times.size(), 1u);
  EXPECT_EQ(loaded.inputs[1].filename(), "base.toml");
}

TEST_F(SceneReader, only_keeps_the_named_muscles) {
  folder.write_box("second.ply", 11, 29);
  std::string second = good_scene();
  second = second.substr(second.find("[[muscles]]"));
  second =
      with(with(second.substr(0, second.find("[motion]")), "\"muscle\"", "\"second\""), "muscle.ply", "second.ply");
  EXPECT_EQ(read(good_scene() + second).scene.muscles.size(), 2u);
  const Scene scene = read(good_scene() + second, {"", {}, {"second"}}).scene;
  ASSERT_EQ(scene.muscles.size(), 1u);
  EXPECT_EQ(scene.muscles[0].name, "second");
}

// ---- What is wrong is said with place, cause and remedy

TEST_F(SceneReader, unknown_keys_suggest_the_nearest_known_one_with_line_and_column) {
  EXPECT_EQ(problems(good_scene() + "[settings]\niteration = 5\n"),
            "scene.toml:40:1: unknown key 'iteration' in [settings] (did you mean 'iterations'?)");
  EXPECT_EQ(code, ExitCode::usage);
  EXPECT_THAT(problems(with(good_scene(), "capture_deg", "capture_degrees")),
              HasSubstr("unknown key 'capture_degrees' in [[axes]] (did you mean 'capture_deg'?)"));
  EXPECT_THAT(problems("colour = 1\n" + good_scene()),
              HasSubstr("scene.toml:1:1: unknown key 'colour' in the scene file"));
}

TEST_F(SceneReader, all_problems_are_listed_at_once) {
  const std::string text = problems(with(with(good_scene(), "schema = 1", "schema = 2"), "\"origin\"", "\"begin\"") +
                                    "[settings]\ndensity = -1\ngravity = 9.81\n[sequence]\nhold = 1\n");
  EXPECT_TRUE(text.starts_with("scene.toml:1:10: only schema 1 is known to this version\nscene.toml:28:7: "))
      << "in the file's order";
  EXPECT_THAT(text, HasSubstr("'end' must be \"origin\" or \"insertion\""));
  EXPECT_THAT(text, HasSubstr("'density' must be a number from 1 to 100000 kg/m³"));
  EXPECT_THAT(text, HasSubstr("'gravity' must be three numbers from -1000 to 1000 m/s²"));
  EXPECT_THAT(text, HasSubstr("unknown key 'hold' in [sequence] (did you mean 'hold_frames'?)"));
}

TEST_F(SceneReader, a_wrap_s_kind_and_plane_must_be_known) {
  const auto with_wrap = [](const std::string& kind, const std::string& plane) {
    return with(
        good_scene(), "[motion]",
        "[muscles.action_line]\nrays = 6\nbodies = [\"pelvis\", \"femur\"]\npoints_mm = [[5, 5, 29], [5, 5, 11]]\n"
        "[[muscles.action_line.wraps]]\nkind = \"" +
            kind + "\"\nbody = \"femur\"\ncenter_mm = [5, 5, 5]\nradii_mm = [3, 2, 2]\nradius_mm = 3\nplane = \"" +
            plane + "\"\n[motion]");
  };
  EXPECT_THAT(problems(with_wrap("ellipsoid", "axial")), Not(HasSubstr("must be")));
  EXPECT_THAT(problems(with_wrap("ellipsoid", "sideways")),
              HasSubstr("'plane' must be \"hybrid\", \"midpoint\" or \"axial\""));
  EXPECT_THAT(problems(with_wrap("cone", "axial")),
              HasSubstr("'kind' must be \"cylinder\", \"sphere\", \"ellipsoid\" or \"torus\""));
}

TEST_F(SceneReader, wrong_types_and_missing_keys_are_named) {
  EXPECT_THAT(problems(with(good_scene(), "\"pelvis.ply\"", "7")),
              HasSubstr("scene.toml:5:8: 'file' must be a text in quotes"));
  EXPECT_THAT(problems(with(good_scene(), "file = \"pelvis.ply\"\n", "")), HasSubstr("[[bones]] needs the key 'file'"));
  EXPECT_THAT(problems(with(good_scene(), "[5, 5, 20]", "[5, 5]")),
              HasSubstr("'center' must be three numbers in brackets"));
  EXPECT_THAT(problems(with(good_scene(), "[5, 5, 20]", "[5, nan, 5]")),
              HasSubstr("'center' must be three numbers in brackets"));
  EXPECT_THAT(problems(with(good_scene(), "[[0], [10]]", "[[0, 1]]")),
              HasSubstr("'key_poses_deg' must be an array of arrays of 1 numbers each"));
  EXPECT_THAT(problems(with(good_scene(), "unit = \"mm\"", "unit = \"inch\"")),
              HasSubstr("'unit' must be \"m\", \"cm\" or \"mm\""));
  EXPECT_THAT(problems(with(good_scene(), "axis = [1, 0, 0]", "axis = [0, 0, 0]")),
              HasSubstr("the axis has no length"));
  EXPECT_THAT(problems(with(good_scene(), "[-10, 20]", "[20, -10]")), HasSubstr("the range ends before it begins"));
  EXPECT_THAT(problems(with(good_scene(), "schema = 1", "")),
              HasSubstr("does not say which schema it follows (add: schema = 1)"));
}

TEST_F(SceneReader, what_is_not_toml_is_reported_with_its_place) {
  EXPECT_THAT(problems("schema = 1\nname = \"unfinished\n"), HasSubstr("scene.toml:2:"));
  EXPECT_EQ(code, ExitCode::usage);
}

TEST_F(SceneReader, duplicates_are_reported_with_the_place_of_the_first) {
  EXPECT_THAT(problems(with(good_scene(), "name = \"femur\"", "name = \"pelvis\"")),
              HasSubstr("bone 'pelvis' stands twice (the first one is at scene.toml:3:1)"));
}

TEST_F(SceneReader, references_to_what_is_not_there_suggest_what_is) {
  EXPECT_THAT(problems(with(good_scene(), "bone = \"pelvis\"", "bone = \"plevis\"")),
              HasSubstr("there is no bone 'plevis' (did you mean 'pelvis'?)"));
  EXPECT_THAT(problems(with(good_scene(), "bone = \"femur\"", "bone = \"femur\"\nbody = \"thigh\"")),
              HasSubstr("there is no body 'thigh'"));
  EXPECT_THAT(problems(with(good_scene(), "coordinates = [\"flexion\"]", "coordinates = [\"flexoin\"]")),
              HasSubstr("there is no coordinate 'flexoin' (did you mean 'flexion'?)"));
  EXPECT_THAT(problems(good_scene(), {"", {}, {"muscel"}}),
              HasSubstr("--only: there is no muscle 'muscel' (did you mean 'muscle'?)"));
  EXPECT_THAT(problems("preset = \"thesis\"\n" + good_scene()), HasSubstr("there is no preset 'thesis'"));
}

TEST_F(SceneReader, a_body_that_hangs_on_no_joint_is_an_error) {
  EXPECT_THAT(problems(with(good_scene(), "name = \"femur\"\n", "name = \"femur\"\nbody = \"thigh\"\n")),
              HasSubstr("body 'thigh': no joint says how it moves against 'pelvis'"));
}

TEST_F(SceneReader, joints_in_a_circle_are_an_error) {
  EXPECT_THAT(problems(with(good_scene(), "[[joints]]",
                            "[[joints]]\nname = \"back\"\nparent = \"femur\"\nchild = \"pelvis\"\n"
                            "center = [0, 0, 0]\n[[joints]]")),
              HasSubstr("moves its own parent"));
}

TEST_F(SceneReader, attachments_must_say_which_vertices_they_take) {
  EXPECT_THAT(problems(with(good_scene(), "bone = \"pelvis\"\nbone_distance_mm = 2\n", "bone = \"pelvis\"\n")),
              HasSubstr("attachment 'top' needs the key 'bone_distance_mm'"));
  EXPECT_THAT(problems(with(good_scene(), "bone = \"pelvis\"\nbone_distance_mm = 2\n", "body = \"pelvis\"\n")),
              HasSubstr("attachment 'top' does not say which vertices it takes"));
  EXPECT_THAT(problems(with(good_scene(), "bone = \"pelvis\"\nbone_distance_mm = 2\n", "vertices = [4]\n")),
              HasSubstr("attachment 'top' is fixed to nothing (give 'bone' or 'body')"));
  EXPECT_THAT(problems(with(good_scene(), "bone_distance_mm = 2", "bone_distance_mm = 2\nvertices = [4]")),
              HasSubstr("attachment 'top' lists its vertices and also asks for distances"));
  EXPECT_THAT(problems(with(good_scene(), "bone_distance_mm = 2",
                            "bone_distance_mm = 2\ncloud = \"a\"\nlandmark_distance_mm = 1")),
              HasSubstr("names a cloud but the scene names no landmark file"));
  EXPECT_THAT(problems(with(good_scene(), "bone_distance_mm = 2", "bone_distance_mm = 0.5")),
              HasSubstr("attachment 'top' of muscle holds no vertex (give larger distances"));
  EXPECT_THAT(
      problems(with(good_scene(), "bone = \"pelvis\"\nbone_distance_mm = 2", "body = \"pelvis\"\nvertices = [8]")),
      HasSubstr("muscle 'muscle', attachment 'top': vertex 8 does not exist (the surface has vertices 0 to 7)"));
}

TEST_F(SceneReader, a_vertex_cannot_move_with_two_bodies) {
  EXPECT_THAT(
      problems(
          with(good_scene(), "bone = \"pelvis\"\nbone_distance_mm = 2", "bone = \"pelvis\"\nbone_distance_mm = 25")),
      HasSubstr("4 of its vertices are fixed to 'pelvis' by the attachment 'top' and cannot move with 'femur' too"));
}

TEST_F(SceneReader, missing_files_are_unreadable_input_and_say_where_they_were_looked_for) {
  const std::string text = problems(with(with(good_scene(), "pelvis.ply", "a/pelvis.ply"), "femur.ply", "b/femur.ply"),
                                    {folder.path("."), {}, {}});
  EXPECT_EQ(code, ExitCode::unreadable_input);
  EXPECT_THAT(text, HasSubstr("scene.toml:3:1: the file 'a/pelvis.ply' does not exist (looked for 'a/pelvis.ply' and"));
  EXPECT_THAT(text, HasSubstr("the file 'b/femur.ply' does not exist"));
  EXPECT_THROW(read_scene(folder.path("none.toml")), InputError);
}

TEST_F(SceneReader, files_are_found_in_the_data_root) {
  std::filesystem::create_directories(folder.path("elsewhere/bones"));
  std::filesystem::rename(folder.path("pelvis.ply"), folder.path("elsewhere/bones/pelvis.ply"));
  const std::string text = with(good_scene(), "pelvis.ply", "bones/pelvis.ply");
  EXPECT_EQ(read(text, {folder.path("elsewhere"), {}, {}}).scene.bones.size(), 2u);
  EXPECT_THAT(problems(text, {folder.path("nowhere"), {}, {}}),
              HasSubstr("the data folder does not exist (it was given by --data)"));
  EXPECT_EQ(code, ExitCode::usage);
}

TEST_F(SceneReader, wrong_settings_on_the_command_line_are_named) {
  EXPECT_THAT(problems(good_scene(), {"", {"iterations"}, {}}),
              HasSubstr("--set iterations: is not of the form key=value"));
  EXPECT_THAT(problems(good_scene(), {"", {"iteration=3"}, {}}),
              HasSubstr("--set iteration=3: unknown key 'iteration' in [settings] (did you mean 'iterations'?)"));
  EXPECT_THAT(problems(good_scene(), {"", {"iterations=0"}, {}}),
              HasSubstr("--set iterations=0: 'iterations' must be an integer from 1 to 100000"));
  EXPECT_THAT(problems(good_scene(), {"", {"muscel.iterations=3"}, {}}),
              HasSubstr("the scene has no muscle 'muscel' (did you mean 'muscle'?)"));
  EXPECT_THAT(problems(good_scene(), {"", {"iterations=;"}, {}}), HasSubstr("the value cannot be read"));
  EXPECT_THAT(problems(good_scene(), {"", {"preset=thesis"}, {}}), HasSubstr("there is no preset 'thesis'"));
}

TEST_F(SceneReader, includes_in_a_circle_are_an_error) {
  folder.write("a.toml", "include = \"scene.toml\"\n");
  EXPECT_THAT(problems("include = \"a.toml\"\n" + good_scene()), HasSubstr("includes itself"));
}

TEST_F(SceneReader, a_problem_in_an_included_file_names_that_file) {
  folder.write("base.toml", good_scene() + "[settings]\nhinge_limi = 1\n");
  EXPECT_THAT(problems("schema = 1\ninclude = \"base.toml\"\n"), HasSubstr("base.toml:40:1: unknown key 'hinge_limi'"));
}

TEST_F(SceneReader, a_motion_beyond_the_range_is_warned_about_and_followed) {
  const LoadedScene loaded = read(with(good_scene(), "[[0], [10]]", "[[0], [35]]"));
  EXPECT_THAT(
      loaded.warnings,
      testing::Contains(HasSubstr("takes flexion from 0 to 35 degrees, beyond the model's range of -10 to 20")));
  EXPECT_NEAR(degrees(loaded.scene.motion.values.maxCoeff()), 35, 1e-12);
}

TEST_F(SceneReader, a_handful_of_vertices_is_warned_about) {
  EXPECT_THAT(read(good_scene()).warnings,
              testing::Contains(HasSubstr("'top' of muscle is held by a handful of vertices (4)")));
}

// ---- The template and the scenes of the repository

TEST_F(SceneReader, the_template_reads_back_with_every_setting_at_its_default) {
  const SceneDescription scene = read_scene_description(folder.write("template.toml", scene_template()), {}, {});
  EXPECT_EQ(list_settings(with_values(XpbdSettings{}, scene.method.settings)), list_settings(XpbdSettings{}));
  EXPECT_EQ(list_settings(with_values(ContactSettings{}, scene.method.contact)), list_settings(ContactSettings{}));
  EXPECT_EQ(list_settings(scene.distance_fields), list_settings(DistanceFieldSettings{}));
  EXPECT_EQ(list_settings(scene.sequence), list_settings(Sequence{}));
  EXPECT_EQ(scene.muscles.at(0).attachments.size(), 4u);
}

TEST_F(SceneReader, the_template_gives_unit_range_and_default_of_every_setting) {
  for (const auto& setting : setting_table<XpbdSettings>()) {
    EXPECT_THAT(scene_template(), HasSubstr("# " + std::string(setting.meaning) + "\n# " + expectation(setting) + "\n" +
                                            std::string(setting.key) + " = "));
  }
}

TEST(Scenes, the_scenes_of_the_cadaver_hip_are_sound) {
  const std::filesystem::path scenes = std::filesystem::path(GRACILIS_SOURCE_DIR) / "scenes" / "lhdl_hip";
  if (!std::filesystem::exists(find_data_root(scenes / "hip.toml", {}) / "lhdl-hip")) {
    GTEST_SKIP() << "the cadaver's data is not there";
  }
  const std::map<std::string, std::size_t> frames = {{"flexion", 193},     {"extension", 37},
                                                     {"abduction", 52},    {"rotation", 67},
                                                     {"flexion_120", 127}, {"flexion_thesis_2024", 193},
                                                     {"flexion_60", 67}};
  for (const auto& [name, count] : frames) {
    SCOPED_TRACE(name);
    const LoadedScene loaded = read_scene(scenes / (name + ".toml"));
    EXPECT_EQ(pose_sequence(loaded.scene).size(), count);
    EXPECT_EQ(loaded.scene.muscles.size(), name == "flexion_120" ? 1u : 5u);
    for (const Muscle& muscle : loaded.scene.muscles) {
      for (const Attachment& attachment : muscle.attachments) {
        const AttachmentArea area = attachment_area(muscle.surface, attachment.vertices);
        EXPECT_GE(area.area, 150e-6) << muscle.name << " " << attachment.name;
        EXPECT_FALSE(area.sliver()) << muscle.name << " " << attachment.name;
      }
    }
  }
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

}  // namespace gracilis
