#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gracilis {

/// Which process wrote something, in a form that other processes, on other machines of a shared disk too, can judge.
struct ProcessMark {
  std::string host;
  std::int64_t process = 0;
  std::int64_t started = 0;  ///< when, in ticks since the machine's start; 0: unknown
};

/// This process.
ProcessMark own_mark();

/// "HOST PROCESS STARTED", and back; nothing where the text is none.
std::string to_text(const ProcessMark& mark);
/// A mark's text as the mark; nothing where the text is none.
std::optional<ProcessMark> parse_mark(std::string_view text);

/// Whether the process is on this machine and runs no more; another one that has got its number since does not count.
/// Nothing can be told about other machines: false.
bool is_gone(const ProcessMark& mark);

}  // namespace gracilis
