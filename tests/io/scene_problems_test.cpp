#include <gracilis/io/scene/scene_reader.hpp>

#include "io/scene_reader_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace gracilis {
namespace {

using testing::HasSubstr;
using testing::Not;

}  // namespace

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

TEST_F(SceneReader, even_parts_of_a_line_cannot_stand_beside_parts_by_its_points) {
  const auto with_sections = [](const std::string& sections) {
    return with(good_scene(), "[motion]",
                "[muscles.action_line]\nrays = 6\nbodies = [\"pelvis\", \"femur\"]\n"
                "points_mm = [[5, 5, 29], [5, 5, 11]]\n" +
                    sections + "[motion]");
  };
  EXPECT_THAT(problems(with_sections("parts = 4\n")), Not(HasSubstr("'parts'")));
  for (const char* other : {"scaling = 2\n", "tendon_sections = true\n"})
    EXPECT_THAT(problems(with_sections(std::string("parts = 4\n") + other)),
                HasSubstr("'parts' puts all sections: it cannot stand beside 'scaling' or 'tendon_sections'"));
  EXPECT_THAT(problems(with_sections("parts = 0\n")), HasSubstr("'parts' must be an integer from 1 to 10000"));
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
              HasSubstr("duplicate bone name 'pelvis' (the first one is at scene.toml:3:1)"));
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
              HasSubstr("attachment 'top' is fixed to nothing (give 'bone', 'body' or 'muscle')"));
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
  EXPECT_THAT(problems(good_scene(), {"", {"quux=3"}, {}}),
              HasSubstr("unknown key 'quux' in [settings] ('gracilis print-config' lists all that are known)"))
      << "there are more than a hundred";
  EXPECT_THAT(problems(good_scene(), {"", {"metod=skinning"}, {}}),
              HasSubstr("--set metod=skinning: unknown key 'metod' (did you mean 'method'?)"));
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

}  // namespace gracilis
