#include <gracilis/io/process_mark.hpp>

#include <gracilis/core/whole_number.hpp>
#include <gracilis/io/text_cells.hpp>
#include <gracilis/io/value_reader.hpp>

#include <fmt/format.h>

#include <signal.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <fstream>
#include <string>
#include <vector>

namespace gracilis {

static std::string host_name() {
  char name[256] = {};
  if (::gethostname(name, sizeof name - 1) != 0 || name[0] == 0) return "localhost";
  std::string host(name);
  for (char& c : host)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.') c = '_';
  return host.substr(0, 64);
}

namespace {

/// What the system says of a process; nothing where there is none.
struct SystemState {
  char state = 0;          ///< 'Z' and 'X': it has ended, but nobody has asked how
  std::int64_t start = 0;  ///< when it began, since the machine did
};

}  // namespace

/// The third and the 22nd word of /proc/PROCESS/stat; counted from the bracket that closes the program's name. Where
/// the process ends meanwhile, reading fails, which a stream's own functions take for an end and its iterators throw.
static SystemState state_of(std::int64_t process) {
  std::ifstream file(fmt::format("/proc/{}/stat", process));
  std::string text;
  std::getline(file, text, '\0');
  const std::size_t bracket = text.rfind(')');
  if (bracket == std::string::npos) return {};
  const std::vector<std::string_view> words = words_of(std::string_view(text).substr(bracket + 1));
  long long start = 0;
  if (words.size() <= 19 || !parse_integer(words[19], start)) return {};
  return {words[0].front(), start};
}

ProcessMark own_mark() {
  const std::int64_t process = ::getpid();
  return {host_name(), process, state_of(process).start};
}

std::string to_text(const ProcessMark& mark) { return fmt::format("{} {} {}", mark.host, mark.process, mark.started); }

std::optional<ProcessMark> parse_mark(std::string_view text) {
  const std::vector<std::string_view> words = words_of(text);
  long long process = 0, started = 0;
  if (words.size() != 3 || !parse_integer(words[1], process) || !parse_integer(words[2], started)) return std::nullopt;
  if (!whole_number<pid_t>(process, 1)) return std::nullopt;
  return ProcessMark{std::string(words[0]), process, started};
}

bool is_gone(const ProcessMark& mark) {
  if (mark.host != host_name()) return false;
  if (::kill(static_cast<pid_t>(mark.process), 0) != 0 && errno == ESRCH) return true;
  const SystemState now = state_of(mark.process);
  if (now.state == 'Z' || now.state == 'X') return true;  // in a container where the first process collects no others
  return mark.started != 0 && now.start != 0 && now.start != mark.started;
}

}  // namespace gracilis
