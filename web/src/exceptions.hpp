#pragma once

namespace gracilis {

/// Ends what is running with a message that the page gets.
[[noreturn]] void fail(const char* text);

}  // namespace gracilis
