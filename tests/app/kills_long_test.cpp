#include <gracilis/io/input_file.hpp>

#include "app/program.hpp"
#include "io/scene_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <random>
#include <set>
#include <sstream>

namespace gracilis {
namespace {

namespace fs = std::filesystem;

/// Runs that are killed again and again, at any moment.
struct KilledRuns : testing::Test {
  KilledRuns() { setenv("XDG_CACHE_HOME", folder.path("cache").c_str(), 1); }

  /// What a run left, by file: all but what tells of times and of the process.
  std::map<std::string, std::string> left_in(const fs::path& run) const {
    static const std::set<std::string> of_the_process = {"run.json", "run.lock", "outputs.sha256"};
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(run)) {
      const std::string name = fs::relative(entry.path(), run).string();
      if (!entry.is_regular_file() || of_the_process.contains(name)) continue;
      const std::string text = read_text(entry.path());
      files[name] = name == "measures.csv" ? without_last_column(text) : text;
    }
    return files;
  }

  /// The last one has milliseconds.
  static std::string without_last_column(const std::string& table) {
    std::istringstream lines(table);
    std::string kept;
    for (std::string line; std::getline(lines, line);) kept += line.substr(0, line.rfind(',')) + "\n";
    return kept;
  }

  /// Kills a run after some of the time that it takes, and begins it again where it stopped, until it is complete.
  int killed_until_complete(const std::string& command, Real seconds) {
    std::uniform_real_distribution<Real> moments(0, seconds);
    const std::string kill = command + " --resume >/dev/null 2>" + log() + " & run=$!; sleep " +
                             std::to_string(moments(random)) + "; kill -KILL $run 2>/dev/null; wait $run";
    int kills = 0;
    for (int code = -1; code != 0; ++kills) {
      code = run_program(kill).exit_code;
      EXPECT_TRUE(code == 0 || code == 128 + 9) << read_text(log());
      if (code != 0 && code != 128 + 9) break;
    }
    return kills - 1;
  }

  void expect_nothing_lost(const std::string& command, int least_kills) {
    const auto in = [&](const char* run) { return command + " --out " + folder.path(run).string(); };
    ASSERT_EQ(run_program(in("whole")).exit_code, 0);
    const auto started = std::chrono::steady_clock::now();
    ASSERT_EQ(run_program(in("whole") + " --force").exit_code, 0);
    const std::chrono::duration<Real> taken = std::chrono::steady_clock::now() - started;
    const std::map<std::string, std::string> whole = left_in(folder.path("whole"));
    ASSERT_GT(whole.size(), 10U);
    for (int kills = 0; kills < least_kills;) {
      fs::remove_all(folder.path("killed"));
      kills += killed_until_complete(in("killed"), taken.count());
      const std::map<std::string, std::string> killed = left_in(folder.path("killed"));
      ASSERT_EQ(killed.size(), whole.size());
      for (const auto& [name, bytes] : whole) ASSERT_TRUE(killed.contains(name) && killed.at(name) == bytes) << name;
    }
  }

  std::string log() const { return folder.path("log").string(); }

  SceneFolder folder;
  std::mt19937 random{7};
};

TEST_F(KilledRuns, of_boxes_end_as_if_nobody_had_killed_them) {
  expect_nothing_lost("run " + folder.write("scene.toml", good_scene()).string() + " --set fibers.count=3", 120);
}

TEST_F(KilledRuns, of_moving_boxes_in_dynamic_mode_do_too) {
  const std::string scene = folder.write("scene.toml", good_scene()).string();
  expect_nothing_lost("run " + scene + " --set time_mode=dynamic --layout compact", 40);
}

TEST_F(KilledRuns, of_the_built_in_hip_do_too) { expect_nothing_lost("demo --flexion 8 --only psoas_r", 40); }

}  // namespace
}  // namespace gracilis
