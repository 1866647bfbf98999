#pragma once

#include <gracilis/io/content_hash.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/run/output_hashes.hpp>

#include "io/scene_folder.hpp"

#include <build_paths.hpp>

#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace gracilis {

/// A muscle between two bones, all of them boxes, and six runs of it, each of a hundred frames in a fraction of a
/// second.
inline const std::string six_runs =
    "scene = \"boxes.toml\"\nmetrics = \"light\"\nfibers = false\n[[parameters]]\nkey = \"motion.step_deg\"\n"
    "values = [0.1, 0.11, 0.12, 0.13, 0.14, 0.15]\n[[outcomes]]\nmetric = \"volume_ratio\"\nstatistic = \"last\"\n";

/// A folder with that scene in it.
struct StudyFolder : SceneFolder {
  StudyFolder() { write("boxes.toml", good_scene()); }
  std::filesystem::path study(const std::string& text, const std::string& name = "study.toml") const {
    return write(name, text);
  }
};

/// Starts the program and does not wait for it.
inline pid_t start_program(const std::vector<std::string>& words) {
  const pid_t child = fork();
  if (child != 0) return child;
  std::vector<char*> arguments = {const_cast<char*>(build_paths::program)};
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  (void)!freopen("/dev/null", "w", stdout);
  (void)!freopen("/dev/null", "w", stderr);
  execv(build_paths::program, arguments.data());
  _exit(127);
}

/// Its exit code; -1 where a signal ended it.
inline int end_of(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Hashes of the surfaces that a run has recorded, by file. (Its measures tell how long frames took.)
inline std::map<std::string, std::string> shapes_of(const std::filesystem::path& run) {
  std::map<std::string, std::string> shapes;
  for (const OutputHash& output : read_output_hashes(run))
    if (output.file.starts_with("shapes/")) shapes[output.file] = content_hash(run / output.file);
  return shapes;
}

inline std::size_t lines_in(const std::filesystem::path& file) {
  const std::string text = read_text(file);
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace gracilis
