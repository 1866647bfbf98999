#include <gracilis/opensim/export/run_paths.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/tables/table.hpp>
#include <gracilis/opensim/reader/crossed_coordinates.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

namespace gracilis::opensim {

/// Columns of fiber_lengths.sto: coordinates first, then each muscle's mean and its fibers.
struct LengthColumns {
  std::vector<Eigen::Index> coordinates, muscles;
};

static LengthColumns columns_of(const Table& table, const std::filesystem::path& path) {
  LengthColumns columns;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const bool mean = i + 1 < table.columns.size() && table.columns[i + 1] == table.columns[i] + "_f000";
    if (mean)
      columns.muscles.push_back(static_cast<Eigen::Index>(i));
    else if (columns.muscles.empty())
      columns.coordinates.push_back(static_cast<Eigen::Index>(i));
  }
  if (columns.muscles.empty() || columns.coordinates.empty())
    throw InputError({path.string(), "", "holds no coordinates with lengths of muscles", "name the folder of a run"});
  return columns;
}

/// The coordinates that are lengths: measures.csv names them with their unit.
static std::set<std::string> translations_of(const std::filesystem::path& run) {
  std::set<std::string> names;
  std::ifstream file(run / "measures.csv");
  std::string label;
  std::getline(file, label);
  std::istringstream labels(label);
  while (std::getline(labels, label, ',') && label != "muscle")
    if (label.ends_with("_mm")) names.insert(label.substr(0, label.size() - 3));
  return names;
}

/// Without the coordinates whose loss hardly matters, one after the other.
static FittedMuscle fit_muscle(const Table& table, const std::set<std::string>& translations,
                               std::vector<Eigen::Index> coordinates, Eigen::Index muscle) {
  const auto fitted = [&](const std::vector<Eigen::Index>& over) {
    Eigen::MatrixXd values = table.values(Eigen::all, over);
    for (std::size_t i = 0; i < over.size(); ++i)
      if (table.in_degrees && translations.count(table.columns[static_cast<std::size_t>(over[i])]) == 0)
        values.col(static_cast<Eigen::Index>(i)) *= radians(1);
    return fit_path(values, table.values.col(muscle));
  };
  PathFit fit = fitted(coordinates);
  for (std::size_t i = coordinates.size(); i-- > 0 && coordinates.size() > 1;) {
    std::vector<Eigen::Index> fewer = coordinates;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
    PathFit without = fitted(fewer);
    if (without.left_out > 1.1 * fit.left_out + 1e-7) continue;
    coordinates = std::move(fewer);
    fit = std::move(without);
  }
  FittedMuscle result{table.columns[static_cast<std::size_t>(muscle)], {}, std::move(fit)};
  for (const Eigen::Index i : coordinates) result.coordinates.push_back(table.columns[static_cast<std::size_t>(i)]);
  return result;
}

/// Those of the columns that the model's muscle of this name crosses; all where it has none or crosses none of them.
static std::vector<Eigen::Index> crossed_columns(const Table& table, const Model& model, const std::string& muscle,
                                                 const std::vector<Eigen::Index>& columns) {
  const Index known = index_of(model.muscles, muscle);
  if (known < 0) return columns;
  std::vector<Eigen::Index> crossed;
  for (const Index i : crossed_coordinates(model, model.muscles[static_cast<std::size_t>(known)].path))
    for (const Eigen::Index column : columns)
      if (table.columns[static_cast<std::size_t>(column)] == model.coordinates[static_cast<std::size_t>(i)].name)
        crossed.push_back(column);
  return crossed.empty() ? columns : crossed;
}

std::vector<FittedMuscle> fit_run(const std::filesystem::path& run, const Model* model) {
  const std::filesystem::path path = run / "fiber_lengths.sto";
  const Table table = read_table(path);
  const LengthColumns columns = columns_of(table, path);
  std::vector<Eigen::Index> moving;
  for (const Eigen::Index i : columns.coordinates)
    if (table.values.col(i).maxCoeff() - table.values.col(i).minCoeff() > 1e-6) moving.push_back(i);
  if (moving.empty() || table.times.size() < 4)
    throw InputError({path.string(), "", "holds no motion to fit lengths to", "run a motion of several frames first"});
  std::vector<FittedMuscle> muscles;
  const std::set<std::string> translations = translations_of(run);
  for (const Eigen::Index muscle : columns.muscles) {
    const std::string& name = table.columns[static_cast<std::size_t>(muscle)];
    muscles.push_back(
        fit_muscle(table, translations, model ? crossed_columns(table, *model, name, moving) : moving, muscle));
  }
  return muscles;
}

std::string function_path_set(const std::string& name, const std::vector<FittedMuscle>& muscles) {
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n<OpenSimDocument Version=\"40600\">\n"
      "  <FunctionBasedPathSet name=\"{}\">\n    <objects>\n",
      name);
  for (const FittedMuscle& muscle : muscles) {
    const Function& function = muscle.fit.function;
    text += fmt::format(
        "      <FunctionBasedPath name=\"/forceset/{}\">\n        <coordinate_paths>{}</coordinate_paths>\n"
        "        <length_function>\n          <MultivariatePolynomialFunction>\n"
        "            <coefficients>{}</coefficients>\n            <dimension>{}</dimension>\n"
        "            <order>{}</order>\n          </MultivariatePolynomialFunction>\n        </length_function>\n"
        "      </FunctionBasedPath>\n",
        muscle.name, fmt::join(muscle.coordinates, " "), fmt::join(function.coefficients, " "), function.dimension,
        function.order);
  }
  return text + "    </objects>\n    <groups />\n  </FunctionBasedPathSet>\n</OpenSimDocument>\n";
}

std::vector<std::string> export_function_paths(const std::filesystem::path& run, const std::filesystem::path& out,
                                               const Model* model) {
  const std::vector<FittedMuscle> muscles = fit_run(run, model);
  write_text_atomically(out, function_path_set(run.filename().string(), muscles));
  std::vector<std::string> lines;
  for (const FittedMuscle& muscle : muscles)
    lines.push_back(fmt::format("{}: order {} in {}; {:.3f} mm root mean square, {:.3f} mm at most", muscle.name,
                                muscle.fit.function.order, fmt::join(muscle.coordinates, ", "),
                                1000 * muscle.fit.left_out, 1000 * muscle.fit.largest));
  return lines;
}

}  // namespace gracilis::opensim
