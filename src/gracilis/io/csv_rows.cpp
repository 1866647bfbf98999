#include <gracilis/io/csv_rows.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/text_cells.hpp>
#include <gracilis/io/value_reader.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

CsvRows::CsvRows(std::filesystem::path path, std::string_view text) : path_(std::move(path)), text_(text) {
  if (text_.starts_with("\xef\xbb\xbf")) text_.remove_prefix(3);
  if (!next_line()) fail("holds nothing but blank lines");
  labels_ = cells_of(line_);
}

void CsvRows::fail(const std::string& what, const std::string& remedy) const {
  throw InputError({path_.string(), std::to_string(line_number_), what, remedy});
}

bool CsvRows::next_line() {
  while (position_ < text_.size()) {
    const std::size_t end = std::min(text_.find('\n', position_), text_.size());
    line_ = trimmed(text_.substr(position_, end - position_));
    position_ = end + 1;
    ++line_number_;
    if (!line_.empty()) return true;
  }
  return false;
}

std::optional<std::size_t> CsvRows::column(std::string_view label) const {
  const auto found = std::find(labels_.begin(), labels_.end(), label);
  if (found == labels_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - labels_.begin());
}

bool CsvRows::next() {
  if (!next_line()) return false;
  cells_ = cells_of(line_);
  return true;
}

std::string_view CsvRows::cell(std::size_t column) const {
  return column < cells_.size() ? cells_[column] : std::string_view();
}

Real CsvRows::number(std::size_t column, std::string_view what) const {
  double value = 0;
  if (!parse_number(cell(column), value) || !std::isfinite(value))
    fail("'" + std::string(cell(column)) + "' is not " + std::string(what));
  return value;
}

}  // namespace gracilis
