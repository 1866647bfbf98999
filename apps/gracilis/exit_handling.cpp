#include "exit_handling.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/core/failure.hpp>

#include <spdlog/pattern_formatter.h>
#include <spdlog/spdlog.h>

#include <fcntl.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <memory>
#include <sstream>
#include <string_view>

namespace gracilis {

static std::atomic<bool> stop{false};
static_assert(std::atomic<bool>::is_always_lock_free, "signal handlers may touch lock-free atomics only");

extern "C" void request_stop(int signal) {
  stop = true;
  std::signal(signal, SIG_DFL);
}

const std::atomic<bool>& stop_requested() {
  static const bool watching = [] {
    std::signal(SIGINT, request_stop);
    std::signal(SIGTERM, request_stop);
    return true;
  }();
  (void)watching;
  return stop;
}

void ignore_size_signals() { std::signal(SIGXFSZ, SIG_IGN); }

void open_closed_streams() {
  for (const int stream : {0, 1, 2}) {
    if (fcntl(stream, F_GETFD) != -1 || errno != EBADF) continue;
    const int opened = open("/dev/null", stream == 2 ? O_WRONLY : O_RDONLY);  // gets the lowest number that is free
    (void)opened;
  }
}

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

void log_printable_text() {
  auto formatter = std::make_unique<spdlog::pattern_formatter>();
  formatter->add_flag<PrintableText>('v').set_pattern("%^%l%$: %v");  // as set_up_logging has it
  spdlog::set_formatter(std::move(formatter));
}

/// Logs a problem per line. A broken file may have tens of thousands, and a name in it any length.
static void log_problems(const std::string& text) {
  constexpr int most_lines = 20;
  constexpr std::size_t longest_line = 4000;
  std::istringstream lines(text);
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    if (count >= most_lines) continue;
    if (line.size() > longest_line) line = line.substr(0, longest_line) + " ...";
    spdlog::error("{}", line);
  }
  if (count > most_lines) spdlog::error("and {} more", count - most_lines);
}

/// What was printed is told to be written at the end only, and then nobody else would look.
static void require_printed() {
  const bool failed = std::fflush(stdout) != 0 || std::ferror(stdout) != 0 || !std::cout.flush();
  if (failed)
    throw InputError({"", "", std::string("the output cannot be written: ") + std::strerror(errno),
                      "check where stdout leads to and the free space there"});
}

int run_guarded(const std::function<int()>& command) {
  try {
    const int code = command();
    require_printed();
    return code;
  } catch (const std::exception&) {
    const Failure failure = current_failure();
    log_problems(failure.text);
    return static_cast<int>(failure.code);
  }
}

}  // namespace gracilis
