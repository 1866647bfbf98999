#pragma once

#include <gracilis/calibrate/evaluator.hpp>
#include <gracilis/calibrate/least_squares.hpp>
#include <gracilis/calibrate/scene_match.hpp>

namespace gracilis {

struct CalibrationOptions {
  std::filesystem::path folder;  ///< what it leaves behind
  std::string definition;        ///< all that decides about what is seen, but for targets and the scene's files
  int at_once = 1;               ///< evaluations
  bool force = false;            ///< begin anew where the folder holds another calibration
  std::function<bool()> is_asked_to_stop = {};
  std::function<void(const std::string&)> say = {};  ///< a line for every evaluation; may be empty
};

/// An evaluation in the history of a calibration.
struct HistoryRow {
  std::vector<std::string> values;
  Real objective = 0;     ///< nan: failed
  std::vector<Real> rms;  ///< per target that is aimed at, m (m³)
  std::string reason;
};

/// What a calibration found.
struct CalibrationResult {
  Calibration calibration;                             ///< without what the scene does not have
  Eigen::VectorXd start, best;                         ///< places in the unit cube
  std::vector<std::string> start_values, best_values;  ///< as settings
  Real start_objective = 0, objective = 0;
  std::vector<std::vector<std::vector<Real>>> before, after;  ///< per target of the calibration, held out or not
  std::vector<std::string> remarks;  ///< per target: why it is not known before or after (nan); empty: it is
  Uncertainty uncertainty;
  std::vector<HistoryRow> history;
  std::string stopped;  ///< why the search ended
  Index evaluations = 0, known = 0;
};

/// Looks for the parameters with which the scene comes nearest to the targets. Files in the folder:
///
///   definition.txt    what the evaluations are of
///   evaluations/      what was seen, a file per evaluation; held_out/ of what is not aimed at
///   evaluations.csv   the history: a row per evaluation, in the order in which the search asked for them
///   log.txt           what processes said
///
/// The search goes the same way again over what is known, so that one that was killed comes to the same history and
/// answer. What is held out and fails is left unknown. Throws ConfigurationError where the folder holds another
/// calibration, QualityError where the scene cannot be evaluated at the start, Interrupted when asked to stop.
CalibrationResult run_calibration(Calibration calibration, const SceneMatch& match, const ObserveFunction& observe,
                                  const CalibrationOptions& options);

}  // namespace gracilis
