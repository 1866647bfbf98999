#include "console.hpp"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>

namespace gracilis {

/// Without control characters but ends of lines and tabulators; those of two bytes in UTF-8 count, too.
static std::string printable(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : 0);
    const bool is_pair = byte == 0xc2 && next >= 0x80 && next < 0xa0;
    const bool is_control = (byte < 0x20 && byte != '\n' && byte != '\t') || byte == 0x7f || is_pair;
    result += is_control ? '?' : text[i];
    if (is_pair) ++i;
  }
  return result;
}

namespace {

/// The message of a line of the log.
class PrintableText : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm&, spdlog::memory_buf_t& line) override {
    const std::string text = printable({message.payload.data(), message.payload.size()});
    line.append(text.data(), text.data() + text.size());
  }
  std::unique_ptr<custom_flag_formatter> clone() const override { return std::make_unique<PrintableText>(); }
};

}  // namespace

void set_up_logging() {
  const char* no_color = std::getenv("NO_COLOR");
  const bool plain = no_color && *no_color;
  auto sink = std::make_shared<spdlog::sinks::stderr_color_sink_mt>(plain ? spdlog::color_mode::never
                                                                          : spdlog::color_mode::automatic);
  auto logger = std::make_shared<spdlog::logger>("gracilis", sink);
  auto formatter = std::make_unique<spdlog::pattern_formatter>();
  formatter->add_flag<PrintableText>('v').set_pattern("%^%l%$: %v");
  logger->set_formatter(std::move(formatter));
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
