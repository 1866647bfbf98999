#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace gracilis {

/// Longest name of a bone or muscle, bytes: with what is added to it, it stays a file's name on every disk.
inline constexpr std::size_t longest_name = 120;

/// Whether a name can stand in a file's name as it is: letters, digits, '_', '-' and '.', not at its beginning, and no
/// longer than `longest_name`.
bool fits_file_name(std::string_view name);

/// Whether a name can be the label of a column in .csv, .sto and .mot files: not empty, without comma, quotation mark
/// or control characters, not blank at either end, and not "time", which tables have anyway.
bool fits_column(std::string_view name);

/// A file's name out of any text, as a model's or an analysis' name: what does not fit becomes '_'. It never leads out
/// of the folder that it is put in. What fits stays as it is; an empty text becomes "unnamed".
std::string file_name_of(std::string_view text);

/// The same, and other than all in `taken`, to which it is added.
std::string file_name_of(std::string_view text, std::set<std::string>& taken);

/// Names of columns that measures.csv has beside coordinates, with their units; the method's own stand before
/// "milliseconds".
const std::vector<std::string>& measure_columns();

}  // namespace gracilis
