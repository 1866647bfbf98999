#pragma once

#include <gracilis/io/content_hash.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/run/output_hashes.hpp>

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

/// An empty folder of this process.
inline std::filesystem::path empty_folder(const std::string& name) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / ("gracilis_study_" + name);
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

inline std::filesystem::path write_study(const std::filesystem::path& folder, const std::string& text,
                                         const std::string& name = "study.toml") {
  std::ofstream(folder / name) << text;
  return folder / name;
}

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
