#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/mesh_pieces.hpp>
#include <gracilis/geometry/signed_distance.hpp>
#include <gracilis/io/mesh/load_surface.hpp>
#include <gracilis/io/mesh/mesh_writer.hpp>

#include "app/program.hpp"
#include "io/glb_parts.hpp"
#include "io/scene_folder.hpp"
#include "shapes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

/// The command: exit code 0 only with surfaces that a run takes, everything else by name.
namespace gracilis {
namespace {

namespace fs = std::filesystem;
using shapes::mm;
using shapes::sphere;
using testing::HasSubstr;
using testing::Not;

/// Of one's vertices to the other's surface, m; negative inside.
Real least_distance(const TriangleMesh& one, const TriangleMesh& other) {
  const SignedDistance distance(other);
  Real least = std::numeric_limits<Real>::infinity();
  for (Index v = 0; v < one.vertex_count(); ++v) least = std::min(least, distance.query(one.vertices.col(v)).distance);
  return least;
}

class PrepareCommand : public testing::Test {
 protected:
  fs::path folder = fs::temp_directory_path() / ("gracilis_prepare_test_" + std::to_string(getpid()));

  PrepareCommand() { fs::create_directories(folder); }
  ~PrepareCommand() override { fs::remove_all(folder); }

  std::string file(const std::string& name, const TriangleMesh& mesh) const {
    const fs::path path = folder / (name + ".vtp");
    write_surface(path, mesh.vertices, mesh.faces);
    return path.string() + " ";
  }
  ProgramResult prepare(const std::string& arguments) const {
    fs::remove_all(folder / "out");
    return run_program("prepare " + arguments + " --out " + (folder / "out").string());
  }
  std::size_t written() const {
    std::size_t count = 0;
    if (!fs::exists(folder / "out")) return 0;
    for (const auto& entry : fs::directory_iterator(folder / "out")) count += entry.path().extension() == ".vtp";
    return count;
  }
  static TriangleMesh result_at(const fs::path& path) { return load_surface(path, 1, SurfaceRole::muscle).mesh; }
  TriangleMesh result(const std::string& name) const { return result_at(folder / "out" / (name + ".vtp")); }
};

TriangleMesh round_muscle(Real x = 0, Real radius = 15 * mm) { return sphere(Vec3(x, 0, 0), radius, 3); }

TEST_F(PrepareCommand, writes_what_a_run_takes) {
  TriangleMesh open = round_muscle();
  open.faces.conservativeResize(3, open.face_count() - 20);
  ASSERT_THROW(load_surface(file("open", open), 1, SurfaceRole::muscle), InputError);
  const ProgramResult done = prepare(file("open", open));
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_NO_THROW(result("open"));
  EXPECT_THAT(done.out, HasSubstr("filled 1 hole"));
  const nlohmann::json told = nlohmann::json::parse(prepare(file("open", open) + "--json").out);
  EXPECT_EQ(told.at("muscles").at(0).at("name"), "open");
}

TEST_F(PrepareCommand, refuses_by_name_what_encloses_nothing_and_writes_nothing) {
  const std::string triangle = file("triangle", shapes::mesh_of({{0, 0, 0}, {0.02, 0, 0}, {0, 0.02, 0}}, {{0, 1, 2}}));
  const std::string both = file("good", round_muscle()) + triangle;
  for (const std::string& files : {triangle, both}) {
    const ProgramResult refused = prepare(files);
    EXPECT_EQ(refused.exit_code, 3) << refused.err;
    EXPECT_THAT(refused.err, HasSubstr("triangle: encloses no volume"));
    EXPECT_EQ(written(), 0u);
  }
  std::ofstream(folder / "empty.ply").close();
  EXPECT_EQ(prepare((folder / "empty.ply").string()).exit_code, 3);
}

TEST_F(PrepareCommand, keeps_going_on_demand_and_names_what_it_leaves_out) {
  std::ofstream(folder / "empty.ply").close();
  const std::string triangle = file("triangle", shapes::mesh_of({{0, 0, 0}, {0.02, 0, 0}, {0, 0.02, 0}}, {{0, 1, 2}}));
  const std::string bad = triangle + file("large", round_muscle(0, 15)) + (folder / "empty.ply").string() + " ";
  const ProgramResult some = prepare(file("good", round_muscle()) + bad + "--keep-going");
  EXPECT_EQ(some.exit_code, 3);
  for (const char* name : {"triangle: encloses no volume", "large.vtp: is 51.96 m large", "empty.ply"})
    EXPECT_THAT(some.err, HasSubstr(name));
  EXPECT_EQ(written(), 1u);
  EXPECT_NO_THROW(result("good"));
  EXPECT_EQ(prepare(bad + "--keep-going").exit_code, 3);
  EXPECT_EQ(written(), 0u);
}

TEST_F(PrepareCommand, does_not_keep_going_without_a_bone) {
  std::ofstream(folder / "empty.ply").close();
  const std::string bone = "--bone " + (folder / "empty.ply").string();
  EXPECT_EQ(prepare(file("good", round_muscle()) + "--keep-going " + bone).exit_code, 3);
  EXPECT_EQ(written(), 0u);
}

TEST_F(PrepareCommand, options_that_the_input_has_no_use_for_are_refused_by_name) {
  std::ofstream(folder / "scene.toml") << good_scene();
  const std::string scene = (folder / "scene.toml").string() + " ", muscle = file("muscle", round_muscle());
  for (const std::string option : {"--split", "--merge", "--largest", "--bone", "--unit"}) {
    const std::string value = option == "--bone" ? " hip.ply" : option == "--unit" ? " mm" : "";
    const ProgramResult refused = prepare(scene + option + value);
    EXPECT_EQ(refused.exit_code, 2) << option;
    EXPECT_THAT(refused.err, HasSubstr(option + ": is for files of surfaces"));
  }
  for (const std::string option : {"--data", "--only"}) {
    const ProgramResult refused = prepare(muscle + option + " muscle");
    EXPECT_EQ(refused.exit_code, 2) << option;
    EXPECT_THAT(refused.err, HasSubstr(option + ": is for a scene"));
  }
}

TEST_F(PrepareCommand, never_writes_over_a_file_that_it_reads) {
  const std::string muscle = file("muscle", round_muscle());
  const auto refused_into = [](const std::string& input, const fs::path& out) {
    const ProgramResult refused = run_program("prepare " + input + "--out " + out.string());
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr("muscle.vtp: is read, and would be overwritten"));
    EXPECT_THAT(refused.err, HasSubstr("name another folder"));
    EXPECT_FALSE(fs::exists(out / "report.txt"));
  };
  refused_into(muscle, folder);
  EXPECT_EQ(result_at(folder / "muscle.vtp").vertices, round_muscle().vertices);
  const SceneFolder scene;
  const TriangleMesh box = shapes::box(Vec3(0, 0, 11), Vec3(10, 10, 29));
  write_surface(scene.path("muscle.vtp"), box.vertices, box.faces);
  const fs::path text = scene.write("scene.toml", with(good_scene(), "muscle.ply", "muscle.vtp"));
  refused_into(text.string() + " ", text.parent_path());
}

TEST_F(PrepareCommand, leaves_overlaps_on_demand) {
  const std::string muscles = file("left", round_muscle()) + file("right", round_muscle(27 * mm));
  const ProgramResult done = prepare(muscles + "--keep-overlaps");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("left and right: "));
  EXPECT_THAT(done.out, Not(HasSubstr("left and right: 0 pairs")));
}

TEST_F(PrepareCommand, pulls_only_those_apart_that_are_named) {
  const std::string files = file("a", round_muscle(-14 * mm)) + file("b", round_muscle(14 * mm)) +
                            file("c", round_muscle(42 * mm)) + "--edge-length 0 ";
  const ProgramResult one = prepare(files + "--apart a");
  ASSERT_EQ(one.exit_code, 0) << one.err;
  const auto low = [](const TriangleMesh& mesh) { return mesh.vertices.row(0).minCoeff(); };
  EXPECT_GE(least_distance(result("a"), result("b")), 0);
  EXPECT_NEAR(low(result("b")), -1 * mm, 0.01 * mm) << "it stays";
  EXPECT_LT(least_distance(result("c"), result("b")), -1 * mm) << "as asked for";
  const ProgramResult unknown = prepare(files + "--apart a,d");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("no muscle is called 'd'"));
  EXPECT_EQ(prepare(files + "--apart a --keep-overlaps").exit_code, 2);
}

TEST_F(PrepareCommand, pulls_pairs_apart_that_are_named_and_leaves_them_in_others) {
  const std::string files = file("a", round_muscle(-14 * mm)) + file("b", round_muscle(14 * mm)) +
                            file("c", round_muscle(42 * mm)) + "--edge-length 0 ";
  const ProgramResult done = prepare(files + "--apart a:b");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_GE(least_distance(result("a"), result("b")), 0);
  EXPECT_GT(result("b").vertices.row(0).minCoeff(), -0.5 * mm) << "each gives way half";
  EXPECT_LT(result("b").vertices.row(0).minCoeff(), 1 * mm);
  EXPECT_NEAR(result("c").vertices.row(0).minCoeff(), 27 * mm, 0.01 * mm) << "it stays";
  EXPECT_LT(least_distance(result("c"), result("b")), -1 * mm);
  const ProgramResult unknown = prepare(files + "--apart a:d");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("no muscle is called 'd'"));
}

TEST_F(PrepareCommand, a_scene_names_what_is_pulled_apart) {
  const SceneFolder scene;
  const std::string all = good_scene();
  const std::size_t first_muscle = all.find("[[muscles]]"), motion = all.find("[motion]");
  std::string text = all.substr(0, first_muscle);
  for (const auto& [name, x] : {std::pair("a", -14 * mm), std::pair("b", 14 * mm), std::pair("c", 42 * mm)}) {
    TriangleMesh mesh = round_muscle(x);
    mesh.vertices.row(1).array() -= 50 * mm;
    write_surface(scene.path(std::string(name) + ".vtp"), mesh.vertices, mesh.faces);
    const std::string muscle =
        with(with(all.substr(first_muscle, motion - first_muscle), "\"muscle\"", "\"" + std::string(name) + "\""),
             "\"muscle.ply\"\nunit = \"mm\"", "\"" + std::string(name) + ".vtp\"");
    text += muscle;
  }
  text += all.substr(motion) + "[prepare]\nedge_length = 0\n";
  const ProgramResult done = prepare(scene.write("pair.toml", text + "apart = [\"a:b\"]\n").string());
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_GE(least_distance(result("a"), result("b")), 0);
  EXPECT_LT(least_distance(result("c"), result("b")), -1 * mm) << "as they are";
  const ProgramResult unknown = prepare(scene.write("unknown.toml", text + "apart = [\"a:d\"]\n").string());
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("no muscle is called 'd'"));
  const ProgramResult both =
      prepare(scene.write("both.toml", text + "keep_overlaps = true\napart = [\"a\"]\n").string());
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_THAT(both.err, HasSubstr("overlaps are to be kept"));
}

TEST_F(PrepareCommand, takes_parts_of_a_glb_by_name) {
  const std::string glb =
      write_parts(folder / "both.glb", {{"left", round_muscle(-20 * mm)}, {"right one", round_muscle(20 * mm)}});
  ASSERT_EQ(prepare(glb + " --part 'right one'").exit_code, 0);
  EXPECT_EQ(written(), 1u);
  EXPECT_GT(result("right_one").vertices.row(0).minCoeff(), 4 * mm);
  const ProgramResult unknown = prepare(glb + " --part lefty");
  EXPECT_EQ(unknown.exit_code, 3);
  EXPECT_THAT(unknown.err, HasSubstr("has no node or mesh 'lefty'"));
  EXPECT_EQ(prepare(file("x", round_muscle()) + "--part left").exit_code, 3) << "no parts there";
}

TEST_F(PrepareCommand, a_wrong_unit_is_told_of_before_any_work) {
  const ProgramResult refused = prepare(file("large", round_muscle(0, 15)));
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_THAT(refused.err, HasSubstr("the unit is wrong"));
}

TEST_F(PrepareCommand, several_bones_follow_one_option) {
  const std::string bones =
      file("a", round_muscle(40 * mm)) + file("b", round_muscle(-40 * mm)) + file("c", round_muscle(80 * mm));
  const ProgramResult done = prepare(file("muscle", round_muscle()) + "--bone " + bones);
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(written(), 1u);  // bones are no muscles
}

TEST_F(PrepareCommand, pieces_are_kept_chosen_split_or_united) {
  const std::string heads = file("heads", merged({round_muscle(), round_muscle(50 * mm, 10 * mm)}));
  ASSERT_EQ(prepare(heads).exit_code, 0);
  EXPECT_EQ(pieces_of(result("heads")).size(), 2u);
  ASSERT_EQ(prepare(heads + "--largest").exit_code, 0);
  EXPECT_EQ(pieces_of(result("heads")).size(), 1u);
  ASSERT_EQ(prepare(heads + "--split").exit_code, 0);
  EXPECT_EQ(written(), 2u);
  ASSERT_EQ(prepare(file("left", round_muscle()) + file("right", round_muscle(18 * mm)) + "--merge").exit_code, 0);
  const TriangleMesh both = result("merged");
  EXPECT_EQ(pieces_of(both).size(), 1u);
  const Real one = 4.0 / 3 * M_PI * std::pow(15 * mm, 3), lens = M_PI * std::pow(6 * mm, 2) * (45 - 6) * mm / 3 * 2;
  EXPECT_NEAR(enclosed_volume(both.vertices, both.faces) / (2 * one - lens), 1, 0.03);
}

TEST_F(PrepareCommand, inspect_names_the_command_that_mends) {
  TriangleMesh open = round_muscle();
  open.faces.conservativeResize(3, open.face_count() - 20);
  const std::string path = file("open", open);
  EXPECT_THAT(run_program("inspect " + path).out, HasSubstr("gracilis prepare " + path.substr(0, path.size() - 1)));
}

}  // namespace
}  // namespace gracilis
