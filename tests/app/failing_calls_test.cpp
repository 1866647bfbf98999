#include <gracilis/io/run/run_folder.hpp>

#include <build_paths.hpp>

#include "app/program.hpp"
#include "io/scene_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

namespace gracilis {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// A small run in which one of all calls that write fails.
class FailingCalls : public testing::Test {
 protected:
  FailingCalls() {
    setenv("XDG_CACHE_HOME", folder.path("cache").c_str(), 1);
    folder.write("scene.toml", good_scene());
  }

  std::string command(const std::string& out) const {
    return " run " + folder.path("scene.toml").string() + " --set iterations=3 --set fibers.count=2 --layout " +
           layout + " --out " + out;
  }
  /// The run into `out` whose call number `at` fails; 0: none does.
  ProgramResult run_failing(const std::string& out, long at) const {
    return run_shell(std::string("LD_PRELOAD=") + build_paths::failing_calls + " GRACILIS_FAULT_FOLDER=" + out +
                     " GRACILIS_FAULT_AT=" + std::to_string(at) + " GRACILIS_FAULT_COUNT=" +
                     folder.path("count").string() + " " + build_paths::program + command(out));
  }
  /// All frames and fibers below a run folder.
  static std::map<std::string, std::string> shapes(const fs::path& out) {
    std::map<std::string, std::string> files;
    for (const char* part : {"frames", "shapes", "bones", "fibers"}) {
      if (!fs::exists(out / part)) continue;
      for (const auto& entry : fs::directory_iterator(out / part)) {
        std::stringstream text;
        text << std::ifstream(entry.path(), std::ios::binary).rdbuf();
        files[fs::relative(entry.path(), out).string()] = text.str();
      }
    }
    return files;
  }

  SceneFolder folder;
  std::string layout = "surfaces";

  void expect_one_message_each();
};

void FailingCalls::expect_one_message_each() {
  const std::string whole = folder.path("whole").string();
  ASSERT_EQ(run_failing(whole, 0).exit_code, 0);
  long calls = 0;
  std::ifstream(folder.path("count")) >> calls;
  ASSERT_GT(calls, 100) << "the calls are not seen";
  const std::map<std::string, std::string> expected = shapes(whole);
  // All of them take an hour; these are of the beginning and spread over the rest.
  for (long at = 1; at <= calls; at += at < 6 ? 1 : calls / 14 + 1) {
    const std::string out = folder.path("out" + std::to_string(at)).string();
    const ProgramResult failed = run_failing(out, at);
    EXPECT_THAT(failed.exit_code, testing::AnyOf(0, 3)) << "call " << at << "\n" << failed.err;
    EXPECT_THAT(failed.err, Not(HasSubstr("internal error"))) << "call " << at;
    if (failed.exit_code == 3) {
      EXPECT_THAT(failed.err, HasSubstr("error: ")) << "call " << at;
    }
    EXPECT_EQ(run_program(command(out) + " --resume --no-pictures 2>/dev/null").exit_code, 0) << "call " << at;
    EXPECT_TRUE(shapes(out) == expected) << "call " << at;
    EXPECT_EQ(run_program("verify " + out).exit_code, 0) << "call " << at;
    fs::remove_all(out);
  }
}

TEST_F(FailingCalls, each_is_one_message_leaves_nothing_half_written_and_can_be_resumed) { expect_one_message_each(); }

TEST_F(FailingCalls, the_same_holds_for_compact_frames) {
  layout = "compact";
  expect_one_message_each();
}

}  // namespace
}  // namespace gracilis
