#include <gracilis/core/errors.hpp>

namespace gracilis {

std::string to_string(const Problem& problem) {
  std::string text = problem.file;
  if (!problem.where.empty()) text += (text.empty() ? "" : ":") + problem.where;
  if (!text.empty()) text += ": ";
  text += problem.what;
  if (!problem.remedy.empty()) text += " (" + problem.remedy + ")";
  return text;
}

static std::string joined(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems) text += (text.empty() ? "" : "\n") + to_string(problem);
  return text;
}

ConfigurationError::ConfigurationError(std::vector<Problem> problems)
    : Error(ExitCode::usage, joined(problems)), problems_(std::move(problems)) {}

InputError::InputError(std::vector<Problem> problems)
    : Error(ExitCode::unreadable_input, joined(problems)), problems_(std::move(problems)) {}

}  // namespace gracilis
