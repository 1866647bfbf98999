#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace gracilis::fuzz {

/// One reader that is handed whatever bytes there are. Whatever they hold, it returns or throws a gracilis::Error;
/// anything else is a flaw.
struct Target {
  std::string name;  ///< also of the folder of its seeds
  std::function<void(std::string_view bytes)> read;
};

/// All readers of files that somebody else may have written.
const std::vector<Target>& targets();

/// Runs a target on bytes, and lets the program end where something other than an Error comes out.
void run(const Target& target, std::string_view bytes);

}  // namespace gracilis::fuzz
