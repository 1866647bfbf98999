#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gracilis {

/// A line's cells: between commas where there is one, else between tabs, else between spaces; trimmed, and unquoted.
/// Empty cells at the end are dropped.
std::vector<std::string_view> cells_of(std::string_view line);

/// A cell between commas as other programs read it (RFC 4180); the end of a line in it becomes a space.
std::string csv_cell(const std::string& text);

/// Cells between any white space or commas.
std::vector<std::string_view> words_of(std::string_view line);

/// Without white space at either end.
std::string_view trimmed(std::string_view text);

/// ASCII letters in lower case, everything else as it is.
std::string lower_case(std::string_view text);

}  // namespace gracilis
