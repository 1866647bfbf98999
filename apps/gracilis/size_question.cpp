#include "size_question.hpp"

#include <gracilis/core/errors.hpp>

#include <fmt/format.h>

#include <unistd.h>

#include <iostream>

namespace gracilis {

void confirm_size(const RunPlan& plan, const SessionOptions& options) {
  confirm_size(plan, options,
               fmt::format("--every N records every Nth frame{}",
                           options.without_fibers ? "" : ", --no-fibers leaves out fibers"));
}

void confirm_size(const RunPlan& plan, const SessionOptions& options, const std::string& fewer) {
  if (plan.size.bytes <= asking_bytes || options.yes || options.resume) return;
  if (isatty(STDIN_FILENO) && isatty(STDERR_FILENO)) {
    fmt::print(stderr, "This writes about {} ({}). Go on? [y/N] ", cost_text(plan), fewer);
    std::string answer;
    if (std::getline(std::cin, answer) && (answer == "y" || answer == "Y" || answer == "yes")) return;
    throw Error(ExitCode::usage, "nothing was run");
  }
  throw Error(ExitCode::usage,
              fmt::format("this would write about {}: --yes does it all the same, {}", cost_text(plan), fewer));
}

}  // namespace gracilis
