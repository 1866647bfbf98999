#pragma once

#include <gracilis/study/study.hpp>

#include <filesystem>
#include <functional>
#include <string>

namespace gracilis {

/// Writes one HTML file that needs nothing but itself: what became of the runs, how each outcome (study/outcomes.hpp)
/// is distributed over them and how it depends on the parameters (study/sensitivity.hpp), and the `worst` runs,
/// farthest beyond the quality gates, with pictures of their last frames. `warn` is told what could not be shown. Whole
/// or not at all. Throws InputError.
void write_study_page(const std::filesystem::path& path, const Study& study, const std::string& version, int worst,
                      const std::function<void(const std::string&)>& warn);

}  // namespace gracilis
