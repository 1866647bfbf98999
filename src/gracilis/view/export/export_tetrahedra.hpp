#pragma once

#include <gracilis/io/run/recorded_run.hpp>

#include <filesystem>
#include <vector>

namespace gracilis {

/// A folder with the tetrahedra of all muscles that are made of sections across their lines, MUSCLE_FRAME.vtu (see
/// write_tetrahedra), and two tables: sections.csv with each section's area and shape, and muscles.csv with volumes,
/// mass, physiological cross-section and the force that it makes with the specific tension (N/m²). Throws InputError.
void export_tetrahedra(const RecordedRun& run, const std::filesystem::path& folder, const std::vector<int>& frames,
                       Real specific_tension);

}  // namespace gracilis
