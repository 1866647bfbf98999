#pragma once

#include <gracilis/view/comparison/comparison_rows.hpp>

#include <filesystem>
#include <vector>

namespace gracilis {

/// Frames of all runs beside each other, as the bytes of a .png each, for the page.
struct ComparisonPicture {
  int frame = 0;  ///< of the first run
  std::string png;
};

/// One per frame. Throws Error (exit code 4) when this machine offers no OpenGL, InputError when a run is damaged.
std::vector<ComparisonPicture> comparison_pictures(const std::vector<ComparedRun>& runs,
                                                   const std::vector<int>& frames);

/// Writes one HTML file that needs nothing but itself: what each method is, all rows, the pictures, and for each muscle
/// charts of volume, fiber length and moment arm with a line per method. `scene` is its title. Whole or not at all.
/// Preconditions: at least one run; all are of one scene. Throws InputError.
void write_comparison_page(const std::filesystem::path& path, const std::string& scene,
                           const std::vector<ComparedRun>& runs, const std::vector<ComparisonRow>& rows,
                           const std::vector<ComparisonPicture>& pictures);

}  // namespace gracilis
