#include "hidden_commands.hpp"

#include "build_info.hpp"
#include "completion.hpp"
#include "manual.hpp"

#include <gracilis/core/errors.hpp>

#include <fmt/format.h>

namespace gracilis {

static int print_completions(const CLI::App& program, const std::string& line) {
  for (const Candidate& candidate : completions(program, line))
    fmt::print("{}{}{}\n", candidate.word, candidate.meaning.empty() ? "" : "\t", candidate.meaning);
  return static_cast<int>(ExitCode::done);
}

Command hidden_command(const CLI::App& program, const std::vector<std::string>& words) {
  if (words.size() != 3) return {};
  const std::string& argument = words[2];
  if (words[1] == "complete") return [&program, argument] { return print_completions(program, argument); };
  if (words[1] == "manual")
    return [&program, argument] {
      write_manual(program, GRACILIS_VERSION, build_info().date, argument);
      return static_cast<int>(ExitCode::done);
    };
  return {};
}

}  // namespace gracilis
