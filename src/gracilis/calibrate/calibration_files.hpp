#pragma once

#include <gracilis/calibrate/run_calibration.hpp>

namespace gracilis {

/// A parameter as people read it: its value, one standard error of it, and the interval that holds it in 95 of 100
/// cases, as far as the bounds go. nan: unknown.
struct ParameterEstimate {
  Real value = 0, error = 0, from = 0, to = 0;
};
/// Of the parameter with this number, at the best values that were found.
ParameterEstimate estimate_of(const CalibrationResult& result, std::size_t parameter);

/// What a calibrated scene is made of, beside the parameters.
struct CalibratedScene {
  std::filesystem::path file;     ///< empty: built in
  std::vector<std::string> set;   ///< --set of the calibration
  std::vector<std::string> only;  ///< --only
};

/// Writes into the folder, each file whole:
///
///   calibrated.toml        the values found, and what --set said, for scenes to include
///   calibrated_scene.toml  the scene with them, to run; none of built-in scenes
///   parameters.csv         parameter,start,calibrated,low,high,scale,standard_error,from_95,to_95,remark
///   fit.csv                target,held_out,muscle,source,angle_deg,aim,before,after,unit,remark: a row per value; of
///                          shapes the root mean square distance; nothing before or after where it is not known
void write_calibration_files(const std::filesystem::path& folder, const CalibrationResult& result,
                             const CalibratedScene& scene);

/// The values found as scene files have them.
std::string calibrated_toml(const CalibrationResult& result, const std::vector<std::string>& set);

}  // namespace gracilis
