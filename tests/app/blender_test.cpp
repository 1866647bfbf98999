#include "app/program.hpp"
#include "io/test_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

/// The add-on in packaging/blender, in Blender without a window; what is asked of it stands in
/// tests/blender/opens_run.py.
namespace gracilis {

TEST(Blender, opens_a_run_that_follows_its_timeline) {
  if (said_by("command -v blender").empty()) GTEST_SKIP() << "blender is not installed";
  const TestFolder folder;
  const std::string run = (folder.path() / "run").string(), root = build_paths::source_folder;
  const ProgramResult made =
      run_program("demo --flexion 4 --only adductor_longus_r --set method=skinning --no-fibers --out " + run);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const std::string said =
      said_by("blender --background --factory-startup --python-exit-code 1 --python " + root +
              "/tests/blender/opens_run.py -- " + root + "/packaging/blender " + run + "\necho \"exit $?\"");
  EXPECT_THAT(said, testing::HasSubstr("exit 0\n"));
  EXPECT_THAT(said, testing::HasSubstr("holds which follow the timeline"));
  EXPECT_THAT(said, testing::Not(testing::HasSubstr("FAILS")));
}

}  // namespace gracilis
