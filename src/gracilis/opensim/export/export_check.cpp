#include <gracilis/opensim/export/export_check.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/opensim/kinematics/low_pass.hpp>
#include <gracilis/opensim/reader/model_reader.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gracilis::opensim {

static StaticOptimizationResult solve(Model model, const StaticOptimizationSetup& setup) {
  bool replace = setup.replace_force_set;
  for (const std::filesystem::path& path : setup.force_sets) {
    if (replace) throw ConfigurationError({path.string(), "", "takes the model's own muscles away", "append it"});
    read_force_set(path, false, model);
    replace = false;
  }
  CoordinateMotion motion = coordinate_motion(model, read_table(setup.coordinates));
  if (setup.cutoff > 0) motion.values = low_pass(motion.times, motion.values, setup.cutoff);
  ExternalLoads loads;
  if (!setup.external_loads.empty()) loads = read_external_loads(model, setup.external_loads);
  const std::vector<std::size_t> rows = rows_of(setup, motion.times);
  if (rows.empty())
    throw ConfigurationError({setup.coordinates.string(), "", "has no row between the times asked for", ""});
  return static_optimization(model, motion, loads, rows, setup.settings);
}

ExportCheck check_export(const Model& before, const Model& after, const StaticOptimizationSetup& setup) {
  if (setup.coordinates.empty())
    throw ConfigurationError({"--check", "", "the set-up names no motion", "name one in <coordinates_file>"});
  const StaticOptimizationResult a = solve(before, setup), b = solve(after, setup);
  ExportCheck check;
  check.instants = a.activations.times.size();
  check.infeasible_before = a.infeasible.size();
  check.infeasible_after = b.infeasible.size();
  for (const Muscle& muscle : before.muscles) {
    const auto own = column_of(a.activations, muscle.name), exported = column_of(b.activations, muscle.name);
    if (!own || !exported) continue;
    const Eigen::VectorXd off = b.activations.values.col(*exported) - a.activations.values.col(*own);
    check.differences.emplace_back(muscle.name, std::sqrt(off.squaredNorm() / static_cast<Real>(off.size())));
  }
  std::stable_sort(check.differences.begin(), check.differences.end(),
                   [](const auto& x, const auto& y) { return x.second > y.second; });
  return check;
}

std::vector<std::string> check_lines(const ExportCheck& check, Real bar) {
  std::vector<std::string> lines;
  for (const auto& [muscle, difference] : check.differences)
    if (difference > bar)
      lines.push_back(fmt::format("{}: activations differ by {:.3f} (root mean square)", muscle, difference));
  std::string all = fmt::format("static optimization at {} instants: {} of {} muscles within {} of activation",
                                check.instants, check.differences.size() - lines.size(), check.differences.size(), bar);
  if (!check.differences.empty())
    all += fmt::format("; the largest difference {:.4f} ({})", check.differences[0].second, check.differences[0].first);
  if (check.infeasible_before + check.infeasible_after > 0)
    all +=
        fmt::format("; too weak at {} instants before and {} after", check.infeasible_before, check.infeasible_after);
  lines.push_back(all);
  return lines;
}

}  // namespace gracilis::opensim
