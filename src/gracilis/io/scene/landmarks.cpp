#include <gracilis/io/scene/landmarks.hpp>

#include <gracilis/io/csv_rows.hpp>
#include <gracilis/io/input_file.hpp>

#include <array>
#include <map>
#include <optional>
#include <utility>

namespace gracilis {

namespace {

/// Which cell of a row says what, and in which unit.
struct LandmarkColumns {
  std::size_t cloud = 0;
  std::optional<std::size_t> index;
  std::array<std::size_t, 3> xyz{};
  Real unit = 1;  ///< m
};

LandmarkColumns columns_of(const CsvRows& rows, Real default_unit) {
  const char* remedy = "the first line must name the columns: cloud,index,x_mm,y_mm,z_mm";
  const auto cloud = rows.column("cloud");
  if (!cloud) rows.fail("names no column 'cloud'", remedy);
  for (const auto& [suffix, unit] : {std::pair{"_mm", 0.001}, {"_cm", 0.01}, {"_m", 1.0}, {"", default_unit}}) {
    const auto x = rows.column(std::string("x") + suffix), y = rows.column(std::string("y") + suffix),
               z = rows.column(std::string("z") + suffix);
    if (x && y && z) return {*cloud, rows.column("index"), {*x, *y, *z}, unit};
  }
  rows.fail("names no columns x, y and z with the same unit", remedy);
}

Points as_matrix(const std::vector<Vec3>& points) {
  Points matrix(3, static_cast<Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) matrix.col(static_cast<Index>(i)) = points[i];
  return matrix;
}

}  // namespace

std::vector<LandmarkCloud> read_landmarks(const std::filesystem::path& path, Real unit) {
  const std::string text = read_text(path);
  CsvRows rows(path, text);
  const LandmarkColumns columns = columns_of(rows, unit);
  std::vector<LandmarkCloud> clouds;
  std::vector<std::vector<Vec3>> points;  // of each cloud
  std::map<std::string, std::size_t> numbers;
  while (rows.next()) {
    const std::string name(rows.cell(columns.cloud));
    if (name.empty()) rows.fail("has no name of a cloud");
    Vec3 point;
    for (std::size_t i = 0; i < 3; ++i)
      point[static_cast<Eigen::Index>(i)] =
          columns.unit * rows.number(columns.xyz[i], "a coordinate of a landmark of '" + name + "'");
    const auto [number, is_new] = numbers.emplace(name, clouds.size());
    if (is_new) clouds.push_back({name, Points(3, 0), {}}), points.emplace_back();
    points[number->second].push_back(point);
    clouds[number->second].labels.emplace_back(columns.index ? rows.cell(*columns.index) : std::string_view());
  }
  if (clouds.empty()) rows.fail("holds no landmarks");
  for (std::size_t i = 0; i < clouds.size(); ++i) clouds[i].points = as_matrix(points[i]);
  return clouds;
}

}  // namespace gracilis
