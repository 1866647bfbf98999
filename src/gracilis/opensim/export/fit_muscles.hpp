#pragma once

#include <gracilis/opensim/export/path_fit.hpp>
#include <gracilis/opensim/export/run_lengths.hpp>

namespace gracilis::opensim {

struct MuscleFitSettings {
  Index poses = 1000;         ///< of the model's own path, spread over the muscle's coordinates
  bool whole_ranges = false;  ///< over the coordinates' whole ranges instead of around where the run goes
  bool run_alone = false;     ///< fit to the run's lengths instead of correcting the model's path
};

/// A muscle's length as a polynomial of the coordinates that change it.
struct FittedMuscle {
  std::string name;
  std::vector<Index> coordinates;  ///< of the model
  Function length;
  PathErrors held_out;    ///< of poses that the fit did not see, spread over the box
  Eigen::VectorXd arms;   ///< root mean square of arms' errors there, a coordinate each, m per rad
  PathErrors beside_run;  ///< of the run's poses, left out in cross-validation, where these say more than the path
  bool corrects = false;  ///< it is the model's path and a correction from the run
  bool from_run = false;  ///< the run's lengths alone
};

/// What became of a run's muscles.
struct FittedMuscles {
  std::vector<FittedMuscle> muscles;
  std::vector<std::string> left_out;  ///< a sentence for each that keeps its original path: which, and why
};

/// Fits every muscle of the samples. One that the model has becomes its own path and a correction: lengths and arms of
/// the path at `poses`, spread over the coordinates that it crosses, plus what the run's lengths changed by more since
/// the capture pose than the path did (than the same fibers did along the model's line, where that is known and arms
/// are not), which is drawn to nothing where the run does not tell (ridge regression, by the weight that predicts
/// left-out poses best). So lengths are those of the path in the capture pose, for which the model's fiber and tendon
/// lengths hold. Muscles that follow the model's lines (method cylinder) need no correction. One that the model lacks,
/// and all with `run_alone`, are fitted to the run's lengths as they are, over the coordinates whose loss would make it
/// worse by a tenth.
FittedMuscles fit_muscles(const LengthSamples& samples, const Model& model, const MuscleFitSettings& settings = {});

}  // namespace gracilis::opensim
