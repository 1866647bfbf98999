#pragma once

#include <gracilis/io/run/recorded_run.hpp>

#include <filesystem>
#include <vector>

namespace gracilis {

/// A folder with a .vtp for each muscle, bone and frame, named and with the same numbers as runs have them whose layout
/// is `surfaces`: for programs that read one surface from one file. `frames` are those of the run; precondition: they
/// are there. Throws InputError.
void export_surfaces(const RecordedRun& run, const std::filesystem::path& folder, const std::vector<int>& frames);

}  // namespace gracilis
