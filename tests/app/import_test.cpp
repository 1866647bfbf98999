#include "app/program.hpp"
#include "opensim/model_texts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis {

using opensim::muscle;
using opensim::pendulum;
using opensim::point;

TEST(ImportCommand, an_imported_model_runs_its_motion) {
  const TestFolder folder;
  const auto model = folder.write(
      "tiny.osim", pendulum(muscle("m", point("/ground", "0.1 0.1 0") + point("/bodyset/rod", "0.05 -0.3 0"))));
  const auto motion = folder.write(
      "swing.mot", "m\nversion=1\nnRows=2\nnColumns=2\ninDegrees=yes\nendheader\ntime\tswing\n0\t0\n1\t3\n");
  const std::string out = (folder.path() / "scene").string();
  const ProgramResult imported =
      run_program("import " + model.string() + " --motion " + motion.string() + " --out " + out);
  ASSERT_EQ(imported.exit_code, 0) << imported.err;
  EXPECT_EQ(imported.out, out + "/swing.toml\n");
  const ProgramResult ran = run_program("run " + out + "/swing.toml --out " + (folder.path() / "run").string());
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "run/frames/m_0001.vtp"));
}

TEST(ImportCommand, a_folder_that_holds_a_model_is_left_alone) {
  const TestFolder folder;
  const auto model = folder.write("tiny.osim", pendulum());
  folder.write("model.toml", "mine");
  const ProgramResult result = run_program("import " + model.string() + " --out " + folder.path().string());
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, testing::HasSubstr("holds a model already"));
}

TEST(ImportCommand, a_missing_surface_is_named_and_fails_when_strict) {
  const TestFolder folder;
  const auto model =
      folder.write("tiny.osim", pendulum("",
                                         "<attached_geometry><Mesh name=\"g\"><mesh_file>rod.vtp</mesh_file></Mesh>"
                                         "</attached_geometry>"));
  const ProgramResult result =
      run_program("import " + model.string() + " --strict --out " + (folder.path() / "out").string());
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_THAT(result.err, testing::HasSubstr("body 'rod': its surface 'rod.vtp' is not found"));
}

}  // namespace gracilis
