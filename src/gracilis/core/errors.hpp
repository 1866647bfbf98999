#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace gracilis {

/// Exit codes of the program; part of its documented interface.
enum class ExitCode {
  done = 0,
  internal = 1,
  usage = 2,
  unreadable_input = 3,
  unsupported = 4,
  quality = 5,
  interrupted = 130
};

/// One thing that is wrong with what the user gave us: where it is, what it is, and what to do about it.
struct Problem {
  std::string file;    ///< path as the user wrote it; empty when there is none
  std::string where;   ///< line and column, or the element's name; may be empty
  std::string what;    ///< what is wrong
  std::string remedy;  ///< what the user can do; may be empty
};

/// "file:where: what (remedy)" on one line.
std::string to_string(const Problem& problem);

/// The base of everything Gracilis throws for a cause outside its own code; knows the exit code it leads to.
class Error : public std::runtime_error {
 public:
  /// `message` is what people read: one problem per line.
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }  ///< what the program ends with

 private:
  ExitCode code_;
};

/// The command line or a configuration is wrong (exit code 2). Lists all problems, one per line.
class ConfigurationError : public Error {
 public:
  explicit ConfigurationError(std::vector<Problem> problems);  ///< a line of the message each
  /// One problem alone.
  explicit ConfigurationError(Problem problem) : ConfigurationError(std::vector<Problem>{std::move(problem)}) {}
  const std::vector<Problem>& problems() const { return problems_; }  ///< one by one, as in the message

 private:
  std::vector<Problem> problems_;
};

/// A file is missing, malformed or holds what cannot be used (exit code 3). Lists all problems, one per line.
class InputError : public Error {
 public:
  explicit InputError(std::vector<Problem> problems);  ///< a line of the message each
  /// One problem alone.
  explicit InputError(Problem problem) : InputError(std::vector<Problem>{std::move(problem)}) {}
  const std::vector<Problem>& problems() const { return problems_; }  ///< one by one, as in the message

 private:
  std::vector<Problem> problems_;
};

/// The simulation produced something that must not be used, such as a non-finite value (exit code 5).
class QualityError : public Error {
 public:
  /// `message` names what is wrong, where, and what helps.
  explicit QualityError(const std::string& message) : Error(ExitCode::quality, message) {}
};

}  // namespace gracilis
