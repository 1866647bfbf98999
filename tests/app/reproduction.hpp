#pragma once

#include <gracilis/core/types.hpp>

#include <build_paths.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <unistd.h>

namespace gracilis {

/// A run of one of the reproductions and the table that it left.
class Reproduction {
 public:
  class Row {
   public:
    explicit Row(std::map<std::string, std::string> cells) : cells_(std::move(cells)) {}
    const std::string& text(const std::string& column) const { return cells_.at(column); }
    /// 0 where the cell is empty.
    Real number(const std::string& column) const { return text(column).empty() ? 0 : std::stod(text(column)); }

   private:
    std::map<std::string, std::string> cells_;
  };

  /// Whether the data have such a folder.
  static bool has_data(const std::string& part = "validation") {
    const char* folder = std::getenv("GRACILIS_DATA");
    return folder && std::filesystem::is_directory(std::filesystem::path(folder) / part);
  }

  explicit Reproduction(const std::string& options, const std::string& name = "modenese-kohout-2020",
                        const std::string& table = "table.csv") {
    std::filesystem::remove_all(folder_);
    const std::string script = std::string(build_paths::source_folder) + "/reproductions/" + name + "/run.sh";
    exit_code = std::system(("GRACILIS='" + std::string(build_paths::program) + "' '" + script + "' --out '" +
                             folder_.string() + "' " + options + " >/dev/null 2>&1")
                                .c_str());
    std::ifstream file(folder_ / table);
    std::string line;
    std::getline(file, line);
    const std::vector<std::string> columns = cells(line);
    while (std::getline(file, line)) {
      std::map<std::string, std::string> row;
      const std::vector<std::string> values = cells(line);
      for (std::size_t i = 0; i < columns.size(); ++i) row[columns[i]] = values.at(i);
      rows_.emplace_back(row);
    }
  }
  ~Reproduction() { std::filesystem::remove_all(folder_); }

  std::vector<Row> rows_of(const std::string& method) const {
    std::vector<Row> found;
    for (const Row& row : rows_)
      if (row.text("method") == method) found.push_back(row);
    return found;
  }

  const std::vector<Row>& rows() const { return rows_; }

  /// The points (x, y) of the curves with this name in figures/NAME.csv.
  std::vector<std::pair<Real, Real>> curve(const std::string& figure, const std::string& name) const {
    std::vector<std::pair<Real, Real>> points;
    std::ifstream file(folder_ / "figures" / (figure + ".csv"));
    for (std::string line; std::getline(file, line);) {
      const std::vector<std::string> row = cells(line);
      if (row.size() == 3 && row[0] == name) points.emplace_back(std::stod(row[1]), std::stod(row[2]));
    }
    return points;
  }

  std::string page() const {
    std::stringstream text;
    text << std::ifstream(folder_ / "index.html").rdbuf();
    return text.str();
  }

  int exit_code = -1;

 private:
  /// Between commas, some of them in quotes.
  static std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> found(1);
    bool quoted = false;
    for (const char c : line) {
      if (c == '"') quoted = !quoted;
      if (c == ',' && !quoted) found.emplace_back();
      if (c != '"' && c != '\r' && (c != ',' || quoted)) found.back() += c;
    }
    return found;
  }

  std::filesystem::path folder_ = std::filesystem::temp_directory_path() / ("gracilis_reproduction_" + std::to_string(getpid()));
  std::vector<Row> rows_;
};

}  // namespace gracilis
