#pragma once

#include <string>
#include <string_view>

namespace gracilis {

/// A text as one word of a shell's command line: as it is where a shell leaves it alone, otherwise between single
/// quotes. For commands that messages advise.
std::string shell_word(std::string_view text);

}  // namespace gracilis
