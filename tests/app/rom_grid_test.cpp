#include <gracilis/io/input_file.hpp>
#include <gracilis/io/tables/table.hpp>

#include "app/program.hpp"
#include "io/scene_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis {
namespace {

using testing::HasSubstr;

/// Boxes about a joint of two axes, by a method whose shapes depend on the pose alone.
class RomGrid : public testing::Test {
 protected:
  ProgramResult rom(const std::string& coordinates, const std::string& out,
                    const std::string& recorded = "--metrics none") const {
    const std::string rotation = "[[joints.axes]]\ncoordinate = \"rotation\"\naxis = [0, 0, 1]\n";
    const auto scene = folder.write("scene.toml", with(good_scene(), "[[muscles]]", rotation + "[[muscles]]"));
    return run_program("rom " + scene.string() + " --set method=skinning --set fibers.count=4 " + recorded + " --out " +
                       folder.path(out).string() + " " + coordinates);
  }
  Table table(const std::string& name) const { return read_table(folder.path(name)); }

  SceneFolder folder;
};

TEST_F(RomGrid, of_two_coordinates_has_the_moment_arms_of_each_range_alone) {
  const ProgramResult grid = rom("--coord flexion=0:10:5 --coord rotation=-6:6:6", "grid");
  ASSERT_EQ(grid.exit_code, 0) << grid.err;
  EXPECT_THAT(grid.out, HasSubstr("moment arm about flexion"));
  EXPECT_THAT(grid.out, HasSubstr("moment arm about rotation"));
  EXPECT_THAT(grid.out, HasSubstr("in 9 poses"));
  ASSERT_EQ(rom("--coord flexion=0:10:5 --coord rotation=-6", "flexion").exit_code, 0);
  ASSERT_EQ(rom("--coord rotation=-6:6:6 --coord flexion=10", "rotation").exit_code, 0);
  const Table about_flexion = table("grid/moment_arms_about_flexion.sto");
  const Table about_rotation = table("grid/moment_arms_about_rotation.sto");
  const Table flexion = table("flexion/moment_arms.sto"), rotation = table("rotation/moment_arms.sto");
  ASSERT_EQ(about_flexion.values.rows(), 9);
  EXPECT_TRUE(about_flexion.values.topRows(3).isApprox(flexion.values, 1e-9));
  // Flexion goes to and fro: it is at 10 degrees in the rows 2, 3 and 8.
  const std::vector<Eigen::Index> rows = {2, 3, 8};
  EXPECT_TRUE(about_rotation.values(rows, Eigen::all).isApprox(rotation.values, 1e-9));
  EXPECT_TRUE(std::filesystem::exists(folder.path("grid/plots/moment_arms_about_flexion_muscle.svg")));
}

TEST_F(RomGrid, as_tables_alone_has_the_tables_and_plots_of_a_run_and_nothing_else) {
  const std::string coordinates = "--coord flexion=0:10:5 --coord rotation=-6:6:6";
  const ProgramResult run = rom(coordinates, "run"), tables = rom(coordinates, "tables", "--tables-only");
  ASSERT_EQ(tables.exit_code, 0) << tables.err;
  EXPECT_THAT(tables.out, HasSubstr("moment arm about flexion"));
  for (const char* name : {"fiber_lengths.sto", "moment_arms_about_flexion.sto", "moment_arms_about_rotation.sto",
                           "plots/moment_arms_about_flexion_muscle.svg"})
    EXPECT_EQ(text_if_there(folder.path(std::string("tables/") + name)),
              text_if_there(folder.path(std::string("run/") + name)))
        << name;
  for (const char* name : {"run.json", "run.pvd", "measures.csv", "frames", "fibers"})
    EXPECT_FALSE(std::filesystem::exists(folder.path(std::string("tables/") + name))) << name;

  const ProgramResult again = rom(coordinates, "tables", "--tables-only");
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.err, HasSubstr("holds tables already"));
  EXPECT_EQ(rom(coordinates, "tables", "--tables-only --force").exit_code, 0);
  EXPECT_EQ(rom(coordinates, "run", "--tables-only --force").exit_code, 2) << "a run is not replaced by tables";
  EXPECT_NE(rom(coordinates, "other", "--tables-only --every 2").exit_code, 0);
}

TEST_F(RomGrid, has_no_reference_and_not_more_frames_than_the_scene_allows) {
  const auto reference = folder.write("arms.csv", "muscle,angle_deg,moment_arm_mm\nmuscle,0,30\nmuscle,5,31\n");
  const ProgramResult compared =
      rom("--coord flexion=0:10:5 --coord rotation=-6:6:6 --reference '" + reference.string() + "'", "compared");
  EXPECT_EQ(compared.exit_code, 2);
  EXPECT_THAT(compared.err, HasSubstr("is about one coordinate"));
  const ProgramResult endless = rom("--coord flexion=0:10:0.001 --coord rotation=-6:6:0.001", "endless");
  EXPECT_EQ(endless.exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(folder.path("endless")));
}

}  // namespace
}  // namespace gracilis
