#pragma once

#include <gracilis/core/types.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gracilis {

/// Walks through a .csv whose first line that is not blank names its columns. Blank lines are skipped. Complaints are
/// InputErrors with file and line.
class CsvRows {
 public:
  /// `text` must outlive this. Fails where there is no line of columns.
  CsvRows(std::filesystem::path path, std::string_view text);

  /// Names of the columns.
  const std::vector<std::string_view>& labels() const { return labels_; }
  /// Number of the column with this name.
  std::optional<std::size_t> column(std::string_view label) const;

  /// Goes to the next row; false at the end.
  bool next();
  /// A cell of the row; empty where the row ends before it.
  std::string_view cell(std::size_t column) const;
  /// A cell as a finite number, or a complaint that it is not `what`, as in "an angle".
  Real number(std::size_t column, std::string_view what) const;

  /// Throws InputError about the line that was read last.
  [[noreturn]] void fail(const std::string& what, const std::string& remedy = "correct the line") const;

 private:
  bool next_line();

  std::filesystem::path path_;
  std::string_view text_, line_;
  std::size_t position_ = 0, line_number_ = 0;
  std::vector<std::string_view> labels_, cells_;
};

}  // namespace gracilis
