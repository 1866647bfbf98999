#pragma once

#include <gracilis/io/run/recorded_run.hpp>

#include <filesystem>
#include <vector>

namespace gracilis {

/// A folder with one .obj per frame, in m, an object for each bone and muscle, and their colors in run.mtl. `frames`
/// are those of the run; precondition: they are there. Throws InputError.
void export_obj(const RecordedRun& run, const std::filesystem::path& folder, const std::vector<int>& frames);

/// A folder with every table of the run as .csv: measures, and fiber lengths, moment arms and how far constraints moved
/// muscles where it has them; and for each muscle its points in these frames (frame, vertex, x, y, z in m). Throws
/// InputError.
void export_csv(const RecordedRun& run, const std::filesystem::path& folder, const std::vector<int>& frames);

}  // namespace gracilis
