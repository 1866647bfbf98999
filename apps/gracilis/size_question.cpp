#include "size_question.hpp"

#include <gracilis/core/errors.hpp>

#include <fmt/format.h>

#include <unistd.h>

#include <iostream>

namespace gracilis {

void confirm_size(const RunPlan& plan, const SessionOptions& options) {
  if (plan.size.bytes <= asking_bytes || options.yes || options.resume) return;
  const std::string fewer = fmt::format("--every N records every Nth frame{}",
                                        options.without_fibers ? "" : ", --no-fibers leaves out fibers");
  if (isatty(STDIN_FILENO) && isatty(STDERR_FILENO)) {
    fmt::print(stderr, "This run writes about {} ({}). Go on? [y/N] ", room_text(plan), fewer);
    std::string answer;
    if (std::getline(std::cin, answer) && (answer == "y" || answer == "Y" || answer == "yes")) return;
    throw Error(ExitCode::usage, "nothing was run");
  }
  throw Error(ExitCode::usage,
              fmt::format("the run would write about {}: --yes runs it all the same, {}", room_text(plan), fewer));
}

}  // namespace gracilis
