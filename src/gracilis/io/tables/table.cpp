#include <gracilis/io/tables/table.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/text_cells.hpp>
#include <gracilis/io/value_reader.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace gracilis {

namespace {

struct Header {
  std::string name;
  std::optional<long long> rows, columns;
  std::optional<bool> in_degrees;
  bool simm = false;
};

/// Reads one file from top to bottom; knows the line it is at.
class TableReader {
 public:
  TableReader(const std::filesystem::path& path, std::string_view text) : path_(path), text_(text) {
    if (text_.starts_with("\xef\xbb\xbf")) text_.remove_prefix(3);
    has_header_end_ = lower_case(text_).find("endheader") != std::string::npos;
  }

  Table read() {
    const Header header = read_header();
    read_labels();
    while (next_line()) {
      if (!trimmed(line_).empty()) read_row();
    }
    if (table_.times.empty()) fail("", "holds no rows of numbers", "export the table again");
    const auto columns = static_cast<Eigen::Index>(table_.columns.size());
    table_.values = Eigen::Map<const Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
        numbers_.data(), static_cast<Eigen::Index>(table_.times.size()), columns);
    judge(header);
    return std::move(table_);
  }

 private:
  [[noreturn]] void fail(const std::string& where, const std::string& what, const std::string& remedy) const {
    throw InputError({path_.string(), where, what, remedy});
  }
  [[noreturn]] void fail_here(const std::string& what, const std::string& remedy = "correct the line") const {
    fail(std::to_string(number_), what, remedy);
  }

  bool next_line() {
    if (position_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', position_), text_.size());
    line_ = text_.substr(position_, end - position_);
    position_ = end + 1;
    ++number_;
    return true;
  }

  /// Up to "endheader"; a table that begins with its column labels has no header at all.
  Header read_header() {
    Header header;
    bool first = true;
    while (next_line()) {
      const std::vector<std::string_view> words = words_of(line_);
      if (words.empty()) continue;
      if (lower_case(words[0]) == "endheader") return header;
      if (!has_header_end_) {
        position_ = static_cast<std::size_t>(line_.data() - text_.data());
        --number_;
        table_.warnings.push_back(path_.string() + ": has no header");
        return header;
      }
      read_header_line(words, first, header);
      first = false;
    }
    fail("", "has no line 'endheader'", "is it a .mot or .sto file?");
  }

  /// "nRows=51", "nRows = 51" and "datarows 51" say the same.
  void read_header_line(const std::vector<std::string_view>& words, bool first, Header& header) {
    const std::string_view line = trimmed(line_);
    const std::size_t equals = line.find('=');
    const std::string key = lower_case(trimmed(equals == std::string_view::npos ? words[0] : line.substr(0, equals)));
    const std::string_view rest = trimmed(line.substr(equals == std::string_view::npos ? words[0].size() : equals + 1));
    const std::vector<std::string_view> values = words_of(rest);
    const std::string value = values.empty() ? "" : lower_case(values[0]);
    long long count = 0;
    if (key == "nrows" || key == "datarows") {
      if (parse_integer(value, count)) header.rows = count;
    } else if (key == "ncolumns" || key == "datacolumns") {
      if (parse_integer(value, count)) header.columns = count;
    } else if (key == "indegrees") {
      if (value != "yes" && value != "no") fail_here(fmt::format("inDegrees must be yes or no, not '{}'", value));
      header.in_degrees = value == "yes";
    } else if (key == "name" && equals == std::string_view::npos && !values.empty()) {
      header.name = rest;
    } else if (first && equals == std::string_view::npos) {
      header.name = line;
    }
    header.simm = header.simm || key == "datarows" || key == "datacolumns";
  }

  void read_labels() {
    while (next_line() && trimmed(line_).empty()) {
    }
    std::vector<std::string_view> labels = cells_of(line_);
    // Padding may put several tabs between two labels.
    if (std::any_of(labels.begin(), labels.end(), [](std::string_view label) { return label.empty(); })) {
      labels = words_of(line_);
    }
    std::set<std::string_view> seen;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      labels_.emplace_back(labels[i]);
      left_out_.push_back(false);
      if (lower_case(labels[i]) == "time" && time_column_ == none) {
        time_column_ = i;
      } else if (!seen.insert(labels[i]).second) {
        leave_out(i, "occurs again; the first one counts");
      }
    }
    if (time_column_ == none) fail_here("has no column 'time'", "name the column of times 'time'");
    if (labels_.size() == 1) warn("has no column beside 'time'");
  }

  void warn(const std::string& what) { table_.warnings.push_back(path_.string() + ": " + what); }

  void leave_out(std::size_t column, const std::string& why) {
    left_out_[column] = true;
    warn(fmt::format("column '{}' {}", labels_[column], why));
  }

  /// Cells between tabs where the row has some: those of quaternions hold four numbers between commas.
  std::vector<std::string_view> cells_of_row() const {
    if (line_.find('\t') == std::string_view::npos || line_.find(',') == std::string_view::npos) return cells_of(line_);
    std::vector<std::string_view> cells;
    for (std::size_t begin = 0; begin <= line_.size();) {
      const std::size_t end = std::min(line_.find('\t', begin), line_.size());
      cells.push_back(trimmed(line_.substr(begin, end - begin)));
      begin = end + 1;
    }
    while (!cells.empty() && cells.back().empty()) cells.pop_back();
    return cells.size() == labels_.size() ? cells : cells_of(line_);
  }

  /// Once the first row shows which columns hold one number.
  void choose_columns(const std::vector<std::string_view>& cells) {
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      if (i == time_column_) continue;
      if (cells[i].find(',') != std::string_view::npos)
        leave_out(i, "holds several numbers in a cell (quaternions or vectors) and is left out");
      if (!left_out_[i]) table_.columns.push_back(labels_[i]);
    }
  }

  void read_row() {
    const std::vector<std::string_view> cells = cells_of_row();
    if (cells.size() != labels_.size())
      fail_here(fmt::format("has {} numbers where there are {} columns", cells.size(), labels_.size()));
    if (table_.times.empty()) choose_columns(cells);
    const Real time = number_in(cells[time_column_], time_label_);
    if (!table_.times.empty() && time < table_.times.back())
      fail_here(fmt::format("time {} does not come after {}", time, table_.times.back()), "sort the rows by time");
    if (!table_.times.empty() && time == table_.times.back()) {
      ++repeated_rows_;
      return;
    }
    table_.times.push_back(time);
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (i != time_column_ && !left_out_[i]) numbers_.push_back(number_in(cells[i], labels_[i]));
  }

  Real number_in(std::string_view cell, const std::string& column) const {
    double value = 0;
    if (!parse_number(cell, value)) fail_here(fmt::format("'{}' in column '{}' is not a number", cell, column));
    if (!std::isfinite(value)) fail_here(fmt::format("column '{}' is {}, which is not a finite number", column, cell));
    return value;
  }

  void judge(const Header& header) {
    table_.name = header.name.empty() ? path_.stem().string() : header.name;
    table_.in_degrees = header.in_degrees.value_or(header.simm);
    if (!header.in_degrees) {
      warn(fmt::format("does not say inDegrees; angles are taken as {}", header.simm ? "degrees" : "radians"));
    }
    if (repeated_rows_ > 0) warn(fmt::format("repeats {} times; the first row of each counts", repeated_rows_));
    const auto rows = static_cast<long long>(table_.times.size()) + repeated_rows_;
    if (header.rows && *header.rows != rows) warn(fmt::format("announces {} rows but has {}", *header.rows, rows));
    const auto columns = static_cast<long long>(labels_.size());
    if (header.columns && *header.columns != columns) {
      warn(fmt::format("announces {} columns but has {}", *header.columns, columns));
    }
  }

  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  std::filesystem::path path_;
  std::string_view text_, line_;
  std::size_t position_ = 0, number_ = 0;
  bool has_header_end_ = true;
  std::size_t time_column_ = none;
  std::string time_label_ = "time";
  std::vector<std::string> labels_;  ///< of all columns, as they stand
  std::vector<bool> left_out_;       ///< per label
  long long repeated_rows_ = 0;
  std::vector<Real> numbers_;
  Table table_;
};

}  // namespace

Table read_table(const std::filesystem::path& path) {
  const std::string text = read_text(path);
  return TableReader(path, text).read();
}

/// Nobody could read such a table again, read_table included.
static void require_finite_table(const std::filesystem::path& path, const Table& table) {
  const auto require = [&](Real value, std::size_t row, const std::string& column) {
    if (!std::isfinite(value))
      throw QualityError(
          fmt::format("{}: would have {} in column '{}' of row {}", path.string(), value, column, row + 1));
  };
  for (std::size_t row = 0; row < table.times.size(); ++row) {
    require(table.times[row], row, "time");
    for (std::size_t i = 0; i < table.columns.size(); ++i)
      require(table.values(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(i)), row, table.columns[i]);
  }
}

void write_sto(const std::filesystem::path& path, const Table& table) {
  require_finite_table(path, table);
  std::string text = fmt::format("{}\nversion=1\nnRows={}\nnColumns={}\ninDegrees={}\nendheader\ntime", table.name,
                                 table.times.size(), table.columns.size() + 1, table.in_degrees ? "yes" : "no");
  for (const std::string& column : table.columns) text += "\t" + column;
  text += "\n";
  for (std::size_t row = 0; row < table.times.size(); ++row) {
    text += fmt::format("{}", table.times[row]);
    for (const Real value : table.values.row(static_cast<Eigen::Index>(row))) text += fmt::format("\t{}", value);
    text += "\n";
  }
  write_text_atomically(path, text);
}

void write_csv(const std::filesystem::path& path, const Table& table) {
  require_finite_table(path, table);
  std::string text = fmt::format("{}\n", fmt::join(table.columns, ","));
  for (const auto row : table.values.rowwise())
    for (Eigen::Index c = 0; c < row.size(); ++c)
      text += fmt::format("{:.12g}{}", row[c] + 0.0, c + 1 < row.size() ? "," : "\n");
  write_text_atomically(path, text);
}

std::string coordinate_of_column(const std::string& column) {
  if (!column.starts_with('/')) return column;
  if (!column.ends_with("/value")) return "";
  const std::string path = column.substr(0, column.size() - std::string_view("/value").size());
  return path.substr(path.rfind('/') + 1);
}

/// The same, but empty for what moves along and for speeds; `translations` are coordinates that may move along.
static std::string moving_coordinate(const std::string& column, const std::vector<std::string>& translations) {
  std::string name = coordinate_of_column(column);
  if (std::find(translations.begin(), translations.end(), name) != translations.end()) return name;
  for (const char* ending : {"_tx", "_ty", "_tz", "Translation", "_speed", "_u"}) {
    if (name.ends_with(ending)) return "";
  }
  return name;
}

std::optional<Eigen::Index> column_of(const Table& table, const std::string& name) {
  const auto found = std::find(table.columns.begin(), table.columns.end(), name);
  if (found == table.columns.end()) return std::nullopt;
  return found - table.columns.begin();
}

Motion motion_from_table(const Table& table, const std::vector<std::string>& translations) {
  Motion motion;
  motion.name = table.name;
  motion.times = table.times;
  motion.values.resize(table.values.rows(), 0);
  for (std::size_t column = 0; column < table.columns.size(); ++column) {
    const std::string coordinate = moving_coordinate(table.columns[column], translations);
    if (coordinate.empty()) continue;
    const bool shifts = std::find(translations.begin(), translations.end(), coordinate) != translations.end();
    motion.coordinates.push_back(coordinate);
    motion.values.conservativeResize(Eigen::NoChange, motion.values.cols() + 1);
    motion.values.rightCols(1) =
        table.values.col(static_cast<Eigen::Index>(column)) * (table.in_degrees && !shifts ? radians(1) : 1);
  }
  return motion;
}

}  // namespace gracilis
