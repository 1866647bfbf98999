#include "exported_paths.hpp"

#include <nlohmann/json.hpp>

namespace gracilis {

nlohmann::ordered_json as_json(const opensim::PathErrors& errors) {
  return {{"length_rms_mm", 1000 * errors.length_root_mean_square},
          {"length_largest_mm", 1000 * errors.length_largest},
          {"arm_rms_mm", 1000 * errors.arm_root_mean_square},
          {"arm_largest_mm", 1000 * errors.arm_largest}};
}

/// The same, arms null where they are not known.
static nlohmann::ordered_json known_errors(const opensim::PathErrors& errors) {
  nlohmann::ordered_json told = as_json(errors);
  if (errors.arm_largest == 0) told["arm_rms_mm"] = told["arm_largest_mm"] = nullptr;
  return told;
}

nlohmann::ordered_json as_json(const opensim::Model& model, const opensim::FittedMuscles& fitted) {
  nlohmann::ordered_json fits = nlohmann::ordered_json::array();
  for (const opensim::FittedMuscle& muscle : fitted.muscles) {
    nlohmann::ordered_json fit = {
        {"muscle", muscle.name}, {"order", muscle.length.order}, {"coordinates", nlohmann::ordered_json::array()}};
    for (const Index i : muscle.coordinates)
      fit["coordinates"].push_back(model.coordinates[static_cast<std::size_t>(i)].name);
    if (!muscle.from_run) fit["beside_model"] = known_errors(muscle.held_out);
    if (muscle.from_run || muscle.corrects) fit["beside_run"] = known_errors(muscle.beside_run);
    fits.push_back(std::move(fit));
  }
  return {{"fits", fits}, {"left_out", fitted.left_out}};
}

nlohmann::ordered_json as_json(const opensim::PointExport& exported) {
  nlohmann::ordered_json paths = nlohmann::ordered_json::array();
  for (const opensim::WrittenPath& path : exported.written)
    paths.push_back({{"muscle", path.muscle},
                     {"points", path.points},
                     {path.beside_model ? "beside_model" : "beside_run", known_errors(path.errors)}});
  return {{"paths", paths}, {"left_out", exported.left_out}};
}

}  // namespace gracilis
