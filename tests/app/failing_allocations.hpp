#pragma once

#include "app/left_in_run.hpp"
#include "app/program.hpp"
#include "io/scene_folder.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace gracilis {

/// A small run in which one of all allocations fails. Nothing is drawn but where a test asks for it: drivers of OpenGL
/// crash or wait for ever when they get no memory.
class FailingAllocations : public testing::Test {
 protected:
  FailingAllocations() {
    setenv("XDG_CACHE_HOME", folder.path("cache").c_str(), 1);
    setenv("__EGL_VENDOR_LIBRARY_DIRS", "/nowhere", 1);
    folder.write("scene.toml", good_scene());
  }

  void SetUp() override {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sanitizers have a malloc of their own";
#endif
  }

  /// So many of the allocations of at least so many bytes, spread over all, fail one by one.
  void expect_one_message_each(int least_bytes, long most) {
    ASSERT_EQ(run_failing("whole", least_bytes, 0).exit_code, 0);
    long allocations = 0;
    std::ifstream(folder.path("count")) >> allocations;
    ASSERT_GT(allocations, 20) << "the allocations are not seen";
    const auto whole = left_in(folder.path("whole"));
    int refused = 0;
    for (long at = 1; at <= allocations; at += std::max(1L, allocations / most)) {
      SCOPED_TRACE(fmt::format("allocation {} of {}", at, allocations));
      const ProgramResult failed = run_failing("out", least_bytes, at);
      if (failed.exit_code == 0) {  // some library did without
        EXPECT_TRUE(left_in(folder.path("out")) == whole);
      } else {
        expect_message(failed);
        ++refused;
      }
      EXPECT_EQ(run_program(run_into("out") + " --resume").exit_code, 0);
      EXPECT_TRUE(left_in(folder.path("out")) == whole);
      EXPECT_EQ(run_program("verify " + folder.path("out").string()).exit_code, 0);
      std::filesystem::remove_all(folder.path("out"));
    }
    EXPECT_GT(refused, 5);
  }

  /// So many of the allocations of at least so many bytes that drawing makes, spread over all, fail one by one: however
  /// the program ends, the run is whole but for its pictures, and what resumes it makes these.
  void expect_whole_runs_without_pictures(int least_bytes, long most) {
    const auto count = [&](const std::string& out) {
      EXPECT_EQ(run_failing(out, least_bytes, 0).exit_code, 0);
      long allocations = 0;
      std::ifstream(folder.path("count")) >> allocations;
      return allocations;
    };
    const long before = count("undrawn");
    unsetenv("__EGL_VENDOR_LIBRARY_DIRS");
    const long all = count("whole");
    const auto whole = left_in(folder.path("whole"));
    if (!whole.count("preview.png")) GTEST_SKIP() << "no picture can be drawn here";
    ASSERT_GT(all, before + 20) << "drawing's allocations are not seen";
    for (long at = before + 1; at <= all; at += std::max(1L, (all - before) / most)) {
      SCOPED_TRACE(fmt::format("allocation {} of {}", at, all));
      run_failing("out", least_bytes, at, "timeout -s KILL 20 ");
      EXPECT_EQ(run_program("verify " + folder.path("out").string()).exit_code, 0);
      EXPECT_EQ(run_program(run_into("out") + " --resume").exit_code, 0);
      EXPECT_TRUE(left_in(folder.path("out")) == whole);
      std::filesystem::remove_all(folder.path("out"));
    }
  }

 private:
  std::string run_into(const std::string& out) const {
    return fmt::format("run {} --set iterations=3 --set fibers.count=2 --threads 2 --out {}",
                       folder.path("scene.toml").string(), folder.path(out).string());
  }

  /// The run in which allocation number `at` fails; 0: none does. `by` stands before the program.
  ProgramResult run_failing(const std::string& out, int least_bytes, long at, const std::string& by = "") const {
    return run_shell(
        fmt::format("{}env LD_PRELOAD={} GRACILIS_FAULT_BYTES={} GRACILIS_FAULT_AT={} GRACILIS_FAULT_COUNT={} {} {}",
                    by, build_paths::failing_allocations, least_bytes, at, folder.path("count").string(),
                    build_paths::program, run_into(out)));
  }

  /// That of a lack of memory (1), or of a file or folder that could not be read for it (3).
  static void expect_message(const ProgramResult& failed) {
    EXPECT_THAT(failed.exit_code, testing::AnyOf(1, 3)) << failed.err;
    EXPECT_THAT(failed.err, testing::ContainsRegex("error: [^\n]*memory[^\n]*\n$"));
    EXPECT_EQ(failed.err.find("error: "), failed.err.rfind("error: ")) << failed.err;
  }

  SceneFolder folder;
};

}  // namespace gracilis
