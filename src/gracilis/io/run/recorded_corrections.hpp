#pragma once

#include <gracilis/io/run/recorded_run.hpp>
#include <gracilis/simulate/corrections.hpp>

#include <string>

namespace gracilis {

/// Whether a run's frames tell what constraints moved.
bool has_corrections(const RecordedRun& run);

/// What each kind of constraint moved a muscle's vertices by since the frame before; of frame 0, and where the run has
/// no corrections, no kind. Throws InputError where the file is damaged.
Corrections recorded_corrections(const RecordedRun& run, const std::string& muscle, int frame);

}  // namespace gracilis
