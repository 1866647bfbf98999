#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/mesh_pieces.hpp>
#include <gracilis/io/mesh/load_surface.hpp>
#include <gracilis/io/mesh/mesh_writer.hpp>

#include "app/program.hpp"
#include "shapes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

/// The command: exit code 0 only with surfaces that a run takes, everything else by name.
namespace gracilis {
namespace {

namespace fs = std::filesystem;
using shapes::mm;
using shapes::sphere;
using testing::HasSubstr;

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
  TriangleMesh result(const std::string& name) const {
    return load_surface(folder / "out" / (name + ".vtp"), 1, SurfaceRole::muscle).mesh;
  }
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
