#pragma once

#include "app/left_in_run.hpp"
#include "app/program.hpp"
#include "io/scene_folder.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <random>

namespace gracilis {

/// Runs that are killed again and again, at any moment.
class KilledRuns : public testing::Test {
 protected:
  KilledRuns() { setenv("XDG_CACHE_HOME", folder.path("cache").c_str(), 1); }

  /// Runs the command, once whole and then killed until there were so many kills: begun again where it was killed until
  /// it is complete, and then anew. What is left must be the same.
  void expect_nothing_lost(const std::string& command, int least_kills) {
    ASSERT_EQ(run_program(in("whole", command)).exit_code, 0);  // fills the caches
    const auto started = std::chrono::steady_clock::now();
    ASSERT_EQ(run_program(in("whole", command) + " --force").exit_code, 0);
    const std::chrono::duration<Real> taken = std::chrono::steady_clock::now() - started;
    const std::map<std::string, std::string> whole = left_in(folder.path("whole"));
    ASSERT_GT(whole.size(), 10U);
    for (int kills = 0; kills < least_kills && !HasFailure();) {
      std::filesystem::remove_all(folder.path("killed"));
      kills += kill_until_complete(in("killed", command) + " --resume", taken.count(), least_kills - kills);
      const std::map<std::string, std::string> killed = left_in(folder.path("killed"));
      for (const auto& [name, bytes] : killed)
        EXPECT_TRUE(whole.contains(name)) << name << " is left after " << kills << " kills";
      for (const auto& [name, bytes] : whole) {
        EXPECT_TRUE(killed.contains(name) && killed.at(name) == bytes)
            << name << " is missing or differs after " << kills << " kills";
      }
      EXPECT_EQ(run_program("verify " + folder.path("killed").string()).exit_code, 0);
    }
  }

  SceneFolder folder;

 private:
  std::string in(const char* run, const std::string& command) const {
    return command + " --out " + folder.path(run).string();
  }

  /// Kills the command at some moment of the time that it takes, again and again; how often. On a machine that became
  /// slow none might come to its end, hence it is let go at last.
  int kill_until_complete(const std::string& command, Real seconds, int most) {
    std::uniform_real_distribution<Real> moments(0, seconds);
    int kills = 0;
    for (; kills < std::min(most, 12); ++kills) {
      const ProgramResult result =
          run_shell(fmt::format("timeout --foreground --signal=KILL {:.3f} {} {}",  // which waits for its end
                                moments(random_), build_paths::program, command));
      if (result.exit_code == 0 || result.exit_code == ended_meanwhile) return kills;
      if (result.exit_code != killed_code) {
        ADD_FAILURE() << "exit code " << result.exit_code << " after " << kills << " kills: " << result.err;
        return kills;
      }
    }
    const ProgramResult rest = run_program(command);
    EXPECT_EQ(rest.exit_code, 0) << rest.err;
    return kills;
  }

  static constexpr int killed_code = 128 + 9;  ///< as shells tell it
  static constexpr int ended_meanwhile = 124;  ///< `timeout` was to kill what had ended by itself

  std::mt19937 random_{7};
};

}  // namespace gracilis
