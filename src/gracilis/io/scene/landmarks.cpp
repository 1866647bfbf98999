#include <gracilis/io/scene/landmarks.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/text_cells.hpp>
#include <gracilis/io/value_reader.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

namespace gracilis {

namespace {

/// Which cell of a row says what, and in which unit.
struct Columns {
  std::size_t cloud = 0;
  std::optional<std::size_t> index;
  std::array<std::size_t, 3> xyz{};
  Real unit = 1;  ///< m
};

class LandmarkReader {
 public:
  LandmarkReader(const std::filesystem::path& path, std::string_view text) : path_(path), text_(text) {
    if (text_.starts_with("\xef\xbb\xbf")) text_.remove_prefix(3);
  }

  std::vector<LandmarkCloud> read(Real default_unit) {
    if (!next_line()) fail("holds nothing but blank lines");
    const Columns columns = read_columns(default_unit);
    while (next_line()) read_row(columns);
    if (clouds_.empty()) fail("holds no landmarks");
    take_points();
    return std::move(clouds_);
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& remedy = "correct the line") const {
    throw InputError({path_.string(), std::to_string(number_), what, remedy});
  }

  /// The next line that is not blank.
  bool next_line() {
    while (position_ < text_.size()) {
      const std::size_t end = std::min(text_.find('\n', position_), text_.size());
      line_ = trimmed(text_.substr(position_, end - position_));
      position_ = end + 1;
      ++number_;
      if (!line_.empty()) return true;
    }
    return false;
  }

  Columns read_columns(Real default_unit) const {
    const std::vector<std::string_view> labels = cells_of(line_);
    const auto find = [&](std::string_view label) -> std::optional<std::size_t> {
      const auto found = std::find(labels.begin(), labels.end(), label);
      if (found == labels.end()) return std::nullopt;
      return static_cast<std::size_t>(found - labels.begin());
    };
    const char* remedy = "the first line must name the columns: cloud,index,x_mm,y_mm,z_mm";
    const auto cloud = find("cloud");
    if (!cloud) fail("names no column 'cloud'", remedy);
    for (const auto& [suffix, unit] : {std::pair{"_mm", 0.001}, {"_cm", 0.01}, {"_m", 1.0}, {"", default_unit}}) {
      const auto x = find(std::string("x") + suffix), y = find(std::string("y") + suffix),
                 z = find(std::string("z") + suffix);
      if (x && y && z) return {*cloud, find("index"), {*x, *y, *z}, unit};
    }
    fail("names no columns x, y and z with the same unit", remedy);
  }

  void read_row(const Columns& columns) {
    const std::vector<std::string_view> cells = cells_of(line_);
    const auto cell = [&](std::size_t i) { return i < cells.size() ? cells[i] : std::string_view(); };
    const std::string name(cell(columns.cloud));
    if (name.empty()) fail("has no name of a cloud");
    Vec3 point;
    for (std::size_t i = 0; i < 3; ++i) {
      double value = 0;
      const std::string_view text = cell(columns.xyz[i]);
      if (!parse_number(text, value) || !std::isfinite(value)) {
        fail(fmt::format("'{}' is not a coordinate of a landmark of '{}'", text, name));
      }
      point[static_cast<Eigen::Index>(i)] = value * columns.unit;
    }
    const auto [number, is_new] = numbers_.emplace(name, clouds_.size());
    if (is_new) clouds_.push_back({name, Points(3, 0), {}}), points_.emplace_back();
    points_[number->second].push_back(point);
    clouds_[number->second].labels.emplace_back(columns.index ? cell(*columns.index) : std::string_view());
  }

  void take_points() {
    for (std::size_t i = 0; i < clouds_.size(); ++i) {
      clouds_[i].points.resize(3, static_cast<Index>(points_[i].size()));
      for (std::size_t k = 0; k < points_[i].size(); ++k) clouds_[i].points.col(static_cast<Index>(k)) = points_[i][k];
    }
  }

  std::filesystem::path path_;
  std::string_view text_, line_;
  std::size_t position_ = 0, number_ = 0;
  std::vector<LandmarkCloud> clouds_;
  std::vector<std::vector<Vec3>> points_;  ///< of each cloud
  std::map<std::string, std::size_t> numbers_;
};

}  // namespace

std::vector<LandmarkCloud> read_landmarks(const std::filesystem::path& path, Real unit) {
  const std::string text = read_text(path);
  return LandmarkReader(path, text).read(unit);
}

}  // namespace gracilis
