#include <gracilis/transfer/transfer_inputs.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/csv_rows.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/parse_toml.hpp>
#include <gracilis/io/scene/files.hpp>
#include <gracilis/io/scene/landmarks.hpp>
#include <gracilis/io/toml_reader.hpp>

#include <fmt/format.h>

#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace gracilis {
namespace {

LandmarkPoints of_table(const std::filesystem::path& path, Real unit) {
  LandmarkPoints points;
  for (const LandmarkCloud& cloud : read_landmarks(path, unit))
    for (Index i = 0; i < cloud.points.cols(); ++i) {
      const std::string& label = cloud.labels[static_cast<std::size_t>(i)];
      const bool alone = cloud.points.cols() == 1;
      points[alone ? cloud.name : label.empty() ? cloud.name + "_" + std::to_string(i) : label] = cloud.points.col(i);
    }
  return points;
}

LandmarkPoints of_toml(const std::filesystem::path& path, Real unit) {
  const toml::table table = parse_written_toml(read_text(path), path.string());
  std::vector<Problem> problems;
  TomlReader reader(table, "the landmarks", problems);
  if (table.contains("unit")) unit = sections::unit_of(reader, "unit");
  LandmarkPoints points;
  for (auto&& [key, node] : table)
    if (key.str() != "unit")
      if (const std::optional<Vec3> point = reader.vector(std::string(key.str())))
        points[std::string(key.str())] = unit * *point;
  if (!problems.empty()) throw ConfigurationError(problems);
  return points;
}

/// m³: from less than a mouse's muscle to more than any animal's.
constexpr Real smallest_volume = 1e-10, largest_volume = 1;

constexpr std::array<std::pair<const char*, Real>, 5> amounts = {{{"volume_cm3", 1e-6},
                                                                  {"volume_ml", 1e-6},
                                                                  {"volume_mm3", 1e-9},
                                                                  {"mass_g", 1e-3 / muscle_density},
                                                                  {"mass_kg", 1 / muscle_density}}};

}  // namespace

LandmarkPoints read_landmark_points(const std::filesystem::path& path, Real unit) {
  require_readable_file(path);
  return lower_case_extension(path) == ".toml" ? of_toml(path, unit) : of_table(path, unit);
}

LandmarkPoints joint_centers(const Scene& scene) {
  LandmarkPoints points;
  for (const Joint& joint : scene.joints) points[joint.name] = joint.frame.translation();
  return points;
}

void require_near(const LandmarkPoints& points, const Eigen::AlignedBox3d& bones, const std::string& option) {
  std::vector<Problem> problems;
  for (const auto& [name, point] : points)
    if (const Real away = (point - bones.center()).stableNorm(); !(away <= 10 * bones.diagonal().norm()))
      problems.push_back({option, "", fmt::format("'{}' lies {:.3g} m away from the bones", name, away),
                          "look at the unit of the landmarks"});
  if (!problems.empty()) throw ConfigurationError(problems);
}

std::map<std::string, Real> read_volumes(const std::filesystem::path& path) {
  require_readable_file(path);
  const std::string text = read_text(path);
  CsvRows rows(path, text);
  const std::optional<std::size_t> muscle = rows.column("muscle");
  std::optional<std::size_t> amount;
  Real unit = 1;
  for (const auto& [name, length] : amounts)
    if (const auto column = rows.column(name); column && !amount) amount = column, unit = length;
  if (!muscle || !amount)
    rows.fail("the table needs the column 'muscle' and one of volume_cm3, volume_ml, volume_mm3, mass_g, mass_kg",
              "name the columns in the first line");
  std::map<std::string, Real> volumes;
  while (rows.next()) {
    const Real value = rows.number(*amount, "a volume or a mass");
    if (!(value > 0)) rows.fail("a muscle has no volume of 0 or less");
    if (!(value * unit >= smallest_volume && value * unit <= largest_volume))
      rows.fail(fmt::format("no muscle has a volume of {:.3g} cm³", 1e6 * value * unit),
                "look at the unit in the column's name");
    if (!volumes.emplace(rows.cell(*muscle), value * unit).second) rows.fail("the muscle is there twice");
  }
  return volumes;
}

}  // namespace gracilis
