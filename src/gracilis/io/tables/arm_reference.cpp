#include <gracilis/io/tables/arm_reference.hpp>

#include <gracilis/io/csv_rows.hpp>
#include <gracilis/io/input_file.hpp>

#include <map>
#include <optional>
#include <tuple>

namespace gracilis {

namespace {

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

ArmColumns columns_of(const CsvRows& rows) {
  const char* remedy = "the first line must name the columns: muscle,angle_deg,moment_arm_mm";
  const auto muscle = rows.column("muscle"), angle = rows.column("angle_deg");
  if (!muscle) rows.fail("names no column 'muscle'", remedy);
  if (!angle) rows.fail("names no column 'angle_deg'", remedy);
  const auto source = rows.column("source") ? rows.column("source") : rows.column("model");
  for (const auto& [label, unit] :
       {std::pair{"moment_arm_mm", 0.001}, {"moment_arm_cm", 0.01}, {"moment_arm_m", 1.0}, {"mean", 1.0}})
    if (const auto arm = rows.column(label))
      return {*muscle, *angle, *arm, rows.column("coordinate"), source, rows.column("min"), rows.column("max"), unit};
  rows.fail("names no column of moment arms", remedy);
}

std::string text_in(const CsvRows& rows, const std::optional<std::size_t>& column) {
  return column ? std::string(rows.cell(*column)) : std::string();
}

void read_arm(const CsvRows& rows, const ArmColumns& columns, Arms& arms) {
  const Real arm = columns.unit * rows.number(columns.arm, "a moment arm");
  const auto bound = [&](const std::optional<std::size_t>& column) {
    return column ? columns.unit * rows.number(*column, "a bound of a moment arm") : arm;
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

}  // namespace

std::vector<ArmCurve> read_arm_reference(const std::filesystem::path& path) {
  const std::string text = read_text(path);
  CsvRows rows(path, text);
  const ArmColumns columns = columns_of(rows);
  std::vector<ArmCurve> curves;
  std::vector<Arms> arms;  // of each curve
  std::map<std::tuple<std::string, std::string, std::string>, std::size_t> numbers;
  while (rows.next()) {
    ArmCurve curve{text_in(rows, columns.muscle), text_in(rows, columns.coordinate), text_in(rows, columns.source)};
    if (curve.muscle.empty()) rows.fail("names no muscle");
    if (curve.source.empty()) curve.source = path.stem().string();
    const auto [at, is_new] = numbers.emplace(std::tuple(curve.muscle, curve.coordinate, curve.source), curves.size());
    if (is_new) curves.push_back(curve), arms.emplace_back();
    read_arm(rows, columns, arms[at->second]);
  }
  if (curves.empty()) rows.fail("holds no moment arms");
  for (std::size_t i = 0; i < curves.size(); ++i) take_arms(arms[i], columns.low && columns.high, curves[i]);
  return curves;
}

}  // namespace gracilis
