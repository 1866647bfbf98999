#pragma once

#include <gracilis/opensim/export/path_samples.hpp>
#include <gracilis/opensim/export/run_lengths.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gracilis::opensim {

/// A muscle's path as it was written, and how far it is from the run.
struct WrittenPath {
  std::string muscle;
  std::size_t points = 0;
  PathErrors errors;
  bool beside_model = false;  ///< the run knows no arms: errors are beside the model's path
};

/// What became of a run's muscles.
struct PointExport {
  std::vector<WrittenPath> written;
  std::vector<std::string> left_out;  ///< those that keep the model's path: which, and why
};

/// Writes the mean fibers of a run's muscles as paths of `count` points or fewer (fit_points): a ForceSet that OpenSim
/// appends to the model or puts in the place of its forces. A point follows one coordinate, of the ones that the
/// muscle crosses (of a muscle that the model lacks: that the run moves) by 5 degrees or 5 mm: any of them, for all of
/// the muscle's points the same, or none, whichever gives the smallest errors of lengths and arms together. Muscles
/// that the model has are written as they stand in its file (`model_file`), along these points and with the tendon's
/// slack length, which takes what the way is longer in the capture pose than the model's path. Muscles whose ends move
/// with no body of the model, whose path is a function, or that follow the model's lines (method cylinder) are written
/// with the model's path. The set is read again, and what is told is told of that. The run's scene must have been made
/// of the model, or share its bodies' places and coordinates. `samples`: the run's lengths (run_lengths), or those of
/// its scene in spread poses with mean fibers (scene_lengths), to which points are fitted then. Throws InputError.
PointExport export_points(const std::filesystem::path& run, const std::filesystem::path& model_file, const Model& model,
                          const LengthSamples& samples, Index count, const std::filesystem::path& out);

}  // namespace gracilis::opensim
