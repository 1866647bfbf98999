#pragma once

#include "app/program.hpp"
#include "study/study_scenes.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <random>
#include <thread>

namespace gracilis {

inline bool has_snakemake() { return std::system("command -v snakemake >/dev/null 2>&1") == 0; }

/// Starts a shell's command as the leader of a group of its own, which can be killed as a whole.
inline pid_t start_group(const std::string& command) {
  const pid_t child = fork();
  if (child != 0) return child;
  setpgid(0, 0);
  execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
  _exit(127);
}

/// A study of so many runs of a few frames by the repository's workflow with two jobs, killed so many times at random
/// with all that it started; then to its end.
inline void expect_snakemake_completes(int runs, int shards, int kills) {
  const StudyFolder boxes;
  const std::filesystem::path folder = boxes.path("");
  const std::filesystem::path study = boxes.study(
      "scene = \"boxes.toml\"\nmetrics = \"light\"\nfibers = false\n[sampling]\nkind = \"sobol\"\nsamples = " +
      std::to_string(runs) + "\n[[parameters]]\nkey = \"pressure\"\nrange = [1, 1.1]\n");
  const std::string results = (folder / "results").string(), log = (folder / "log.txt").string();
  const std::string begin = "cd " + folder.string() + " && HOME=" + folder.string() + " exec snakemake -s " +
                            build_paths::source_folder + "/studies/Snakefile -j 2 --nolock --rerun-incomplete ";
  const std::string line = begin + "--config gracilis=" + build_paths::program + " study=" + study.string() +
                           " folder=" + results + " shards=" + std::to_string(shards) + " >>" + log + " 2>&1";
  std::mt19937 random(3);
  for (int i = 0; i < kills; ++i) {
    const pid_t group = start_group(line);
    std::this_thread::sleep_for(std::chrono::milliseconds(2500 + random() % 4000));
    kill(-group, SIGKILL);
    end_of(group);
  }
  EXPECT_EQ(end_of(start_group(line)), 0) << read_text(log);
  const std::string status = run_program("study status " + study.string() + " --folder " + results).out;
  EXPECT_NE(status.find(" " + std::to_string(runs) + " complete\n"), std::string::npos) << status;
  EXPECT_EQ(lines_in(results + "/runs.csv"), static_cast<std::size_t>(runs) + 1);
  EXPECT_TRUE(std::filesystem::exists(results + "/report.html"));
}

}  // namespace gracilis
