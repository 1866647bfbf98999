#pragma once

#include <string>
#include <string_view>

namespace gracilis {

/// A text between double quotes, as TOML, JSON and USD take it: quotes and backslashes behind a backslash, an end of
/// line as \n; other characters below a space become one.
std::string quoted_text(std::string_view text);

}  // namespace gracilis
