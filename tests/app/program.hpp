#pragma once

#include <build_paths.hpp>

#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace gracilis {

/// What a run of the program left behind.
struct ProgramResult {
  int exit_code = -1;
  std::string out;  ///< stdout
  std::string err;  ///< stderr
};

inline std::string read_all(std::FILE* pipe) {
  std::string text;
  char buffer[4096];
  while (const std::size_t count = std::fread(buffer, 1, sizeof buffer, pipe)) text.append(buffer, count);
  return text;
}

/// stdout and stderr of a shell's command line.
inline std::string said_by(const std::string& command) {
  std::FILE* pipe = popen(("{ " + command + "\n} 2>&1").c_str(), "r");
  std::string text = read_all(pipe);
  pclose(pipe);
  return text;
}

/// Runs a shell's command line.
inline ProgramResult run_shell(const std::string& line) {
  char errors[] = "/tmp/gracilis_stderr_XXXXXX";
  const int descriptor = mkstemp(errors);
  const std::string command = line + " 2>" + errors;
  ProgramResult result;
  std::FILE* pipe = popen(command.c_str(), "r");
  result.out = read_all(pipe);
  const int status = pclose(pipe);
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  std::FILE* file = fdopen(descriptor, "r");
  result.err = read_all(file);
  std::fclose(file);
  std::remove(errors);
  return result;
}

/// Runs the program with these arguments, as a shell would read them.
inline ProgramResult run_program(const std::string& arguments) {
  return run_shell(std::string(build_paths::program) + " " + arguments);
}

}  // namespace gracilis
