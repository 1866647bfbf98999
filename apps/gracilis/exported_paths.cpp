#include "exported_paths.hpp"

#include <nlohmann/json.hpp>

namespace gracilis {

/// In mm (of translations: mm per m); arms are null where they are not known.
static nlohmann::ordered_json errors_json(const opensim::PathErrors& errors) {
  nlohmann::ordered_json arm_rms, arm_largest;
  if (errors.arm_largest > 0) arm_rms = 1000 * errors.arm_root_mean_square, arm_largest = 1000 * errors.arm_largest;
  return {{"length_rms_mm", 1000 * errors.length_root_mean_square},
          {"length_largest_mm", 1000 * errors.length_largest},
          {"arm_rms_mm", arm_rms},
          {"arm_largest_mm", arm_largest}};
}

nlohmann::ordered_json as_json(const opensim::Model& model, const opensim::FittedMuscles& fitted) {
  nlohmann::ordered_json fits = nlohmann::ordered_json::array();
  for (const opensim::FittedMuscle& muscle : fitted.muscles) {
    nlohmann::ordered_json fit = {
        {"muscle", muscle.name}, {"order", muscle.length.order}, {"coordinates", nlohmann::ordered_json::array()}};
    for (const Index i : muscle.coordinates)
      fit["coordinates"].push_back(model.coordinates[static_cast<std::size_t>(i)].name);
    if (!muscle.from_run) fit["beside_model"] = errors_json(muscle.held_out);
    if (muscle.from_run || muscle.corrects) fit["beside_run"] = errors_json(muscle.beside_run);
    fits.push_back(std::move(fit));
  }
  return {{"fits", fits}, {"left_out", fitted.left_out}};
}

nlohmann::ordered_json as_json(const opensim::PointExport& exported) {
  nlohmann::ordered_json paths = nlohmann::ordered_json::array();
  for (const opensim::WrittenPath& path : exported.written)
    paths.push_back({{"muscle", path.muscle},
                     {"points", path.points},
                     {path.beside_model ? "beside_model" : "beside_run", errors_json(path.errors)}});
  return {{"paths", paths}, {"left_out", exported.left_out}};
}

}  // namespace gracilis
