#include <gracilis/io/tables/arm_reference.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/csv_rows.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/io/tables/table.hpp>

#include <map>
#include <optional>
#include <tuple>

namespace gracilis {

namespace {

/// What a table tells of muscles.
struct ToldQuantity {
  std::string column;  ///< its name without the unit
  std::string one;     ///< in messages
};
const ToldQuantity told_arm = {"moment_arm", "a moment arm"};
const ToldQuantity told_length = {"length", "a length"};

/// Which cell of a row says what.
struct ArmColumns {
  std::size_t muscle = 0, angle = 0, arm = 0;
  std::optional<std::size_t> coordinate, source, low, high;
  Real unit = 1;  ///< m, of arms
};

/// Of one angle, m.
struct Arm {
  Real arm, low, high;
};
/// By angles, rad.
using Arms = std::map<Real, Arm>;

ArmColumns columns_of(const CsvRows& rows, const ToldQuantity& told) {
  const std::string remedy = "the first line must name the columns: muscle,angle_deg," + told.column + "_mm";
  const auto muscle = rows.column("muscle"), angle = rows.column("angle_deg");
  if (!muscle) rows.fail("names no column 'muscle'", remedy);
  if (!angle) rows.fail("names no column 'angle_deg'", remedy);
  const auto source = rows.column("source") ? rows.column("source") : rows.column("model");
  for (const auto& [label, unit] :
       {std::pair{told.column + "_mm", 0.001}, {told.column + "_cm", 0.01}, {told.column + "_m", 1.0}, {"mean", 1.0}})
    if (const auto arm = rows.column(label))
      return {*muscle, *angle, *arm, rows.column("coordinate"), source, rows.column("min"), rows.column("max"), unit};
  rows.fail("names no column of " + told.one.substr(2) + "s", remedy);
}

std::string text_in(const CsvRows& rows, const std::optional<std::size_t>& column) {
  return column ? std::string(rows.cell(*column)) : std::string();
}

void read_arm(const CsvRows& rows, const ArmColumns& columns, const ToldQuantity& told, Arms& arms) {
  const Real arm = columns.unit * rows.number(columns.arm, told.one);
  const auto bound = [&](const std::optional<std::size_t>& column) {
    return column ? columns.unit * rows.number(*column, "a bound of " + told.one) : arm;
  };
  const Real angle = radians(rows.number(columns.angle, "an angle"));
  const Arm read{arm, bound(columns.low), bound(columns.high)};
  if (!arms.emplace(angle, read).second)
    rows.fail("tells an angle of '" + std::string(rows.cell(columns.muscle)) + "' twice");
}

void take_arms(const Arms& arms, bool has_band, ArmCurve& curve) {
  for (const auto& [angle, arm] : arms) {
    curve.angles.push_back(angle);
    curve.arms.push_back(arm.arm);
    if (!has_band) continue;
    curve.low.push_back(arm.low);
    curve.high.push_back(arm.high);
  }
}

std::vector<ArmCurve> curves_of_csv(const std::filesystem::path& path, const ToldQuantity& told) {
  const std::string text = read_text(path);
  CsvRows rows(path, text);
  const ArmColumns columns = columns_of(rows, told);
  std::vector<ArmCurve> curves;
  std::vector<Arms> arms;  // of each curve
  std::map<std::tuple<std::string, std::string, std::string>, std::size_t> numbers;
  while (rows.next()) {
    ArmCurve curve{text_in(rows, columns.muscle), text_in(rows, columns.coordinate), text_in(rows, columns.source)};
    if (curve.muscle.empty()) rows.fail("names no muscle");
    if (curve.source.empty()) curve.source = path.stem().string();
    const auto [at, is_new] = numbers.emplace(std::tuple(curve.muscle, curve.coordinate, curve.source), curves.size());
    if (is_new) curves.push_back(curve), arms.emplace_back();
    read_arm(rows, columns, told, arms[at->second]);
  }
  if (curves.empty()) rows.fail("holds no " + told.one.substr(2) + "s");
  for (std::size_t i = 0; i < curves.size(); ++i) take_arms(arms[i], columns.low && columns.high, curves[i]);
  return curves;
}

std::vector<ArmCurve> curves_of_table(const std::filesystem::path& path, const std::string& coordinate) {
  const Table table = read_table(path);
  const std::optional<Eigen::Index> angle = column_of(table, coordinate);
  if (!angle)
    throw InputError({path.string(), "", "has no column '" + coordinate + "' of angles",
                      coordinate.empty() ? "say which coordinate it is about" : suggestion(coordinate, table.columns)});
  std::vector<ArmCurve> curves;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    if (static_cast<Eigen::Index>(c) == *angle) continue;
    Arms arms;
    for (Eigen::Index row = 0; row < table.values.rows(); ++row) {
      const Real value = table.values(row, static_cast<Eigen::Index>(c));
      arms[(table.in_degrees ? radians(1) : 1) * table.values(row, *angle)] = {value, value, value};
    }
    take_arms(arms, false, curves.emplace_back(ArmCurve{table.columns[c], coordinate, path.stem().string()}));
  }
  return curves;
}

std::vector<ArmCurve> curves_of(const std::filesystem::path& path, const std::string& coordinate,
                                const ToldQuantity& told) {
  const std::string extension = lower_case_extension(path);
  return extension == ".sto" || extension == ".mot" ? curves_of_table(path, coordinate) : curves_of_csv(path, told);
}

}  // namespace

std::vector<ArmCurve> read_arm_reference(const std::filesystem::path& path, const std::string& coordinate) {
  return curves_of(path, coordinate, told_arm);
}

std::vector<ArmCurve> read_length_reference(const std::filesystem::path& path, const std::string& coordinate) {
  return curves_of(path, coordinate, told_length);
}

}  // namespace gracilis
