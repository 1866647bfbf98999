#include "console.hpp"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <unistd.h>

#include <cstdio>
#include <cstdlib>

namespace gracilis {

void set_up_logging() {
  const char* no_color = std::getenv("NO_COLOR");
  const bool plain = no_color && *no_color;
  auto sink = std::make_shared<spdlog::sinks::stderr_color_sink_mt>(plain ? spdlog::color_mode::never
                                                                          : spdlog::color_mode::automatic);
  auto logger = std::make_shared<spdlog::logger>("gracilis", sink);
  logger->set_pattern("%^%l%$: %v");
  spdlog::set_default_logger(logger);
}

Progress::Progress(int first, int last) : first_(first), last_(last), terminal_(isatty(STDERR_FILENO)) {}

std::string Progress::time_left(int done) const {
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const double left = done > first_ ? seconds / (done - first_) * (last_ - done) : 0;
  return left < 100 ? fmt::format("{:.0f} s left", left) : fmt::format("{:.0f} min left", left / 60);
}

void Progress::show(int done) {
  if (terminal_) {
    constexpr int width = 40;
    const int filled = last_ > 0 ? width * done / last_ : width;
    fmt::print(stderr, "\r[{:#>{}}{:.>{}}] frame {} of {}, {}   ", "", filled, "", width - filled, done, last_,
               time_left(done));
    std::fflush(stderr);
    drawn_ = true;
    return;
  }
  const int tenth = last_ > 0 ? 10 * done / last_ : 10;
  if (tenth == tenth_) return;
  tenth_ = tenth;
  spdlog::info("frame {} of {}, {}", done, last_, time_left(done));
}

void Progress::clear() {
  if (drawn_) fmt::print(stderr, "\r{:80}\r", "");
  drawn_ = false;
}

}  // namespace gracilis
