#pragma once

#include <gracilis/opensim/export/fit_muscles.hpp>
#include <gracilis/opensim/export/run_points.hpp>

#include <nlohmann/json_fwd.hpp>

namespace gracilis {

/// For programs, mm (of translations: mm per m): `length_rms_mm`, `length_largest_mm`, `arm_rms_mm`, `arm_largest_mm`.
nlohmann::ordered_json as_json(const opensim::PathErrors& errors);

/// Of each muscle that was fitted order, coordinates and errors (mm) beside the model's path and the run;
/// and what was left out.
nlohmann::ordered_json as_json(const opensim::Model& model, const opensim::FittedMuscles& fitted);

/// Of each muscle that was written as points how many, and errors (mm) beside the run, or the model where that knows
/// more; and what was left out.
nlohmann::ordered_json as_json(const opensim::PointExport& exported);

}  // namespace gracilis
