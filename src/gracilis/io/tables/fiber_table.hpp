#pragma once

#include <gracilis/scene/scene.hpp>
#include <gracilis/simulate/fiber_tracker.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gracilis {

/// The head of fiber_lengths.sto: "endheader" and the columns time, the scene's coordinates (degrees or m), and per
/// muscle with fibers its mean, `<muscle>`, and its fibers `<muscle>_f000`, `<muscle>_f001` ... (m). `rows` is how many
/// are to come. `fibers` are those of any frame.
std::string fiber_lengths_head(const Scene& scene, const std::vector<MuscleFibers>& fibers, int rows);

/// One row of that table.
std::string fiber_lengths_row(const Scene& scene, const Pose& pose, const std::vector<MuscleFibers>& fibers);

/// Drops all rows but the first `rows`; the head then announces `announced`. Does nothing when there is no file.
void truncate_fiber_lengths(const std::filesystem::path& path, int rows, int announced);

/// `RUN/fibers/<muscle>_<number as four digits>.vtp`
std::filesystem::path fiber_file(const std::filesystem::path& folder, const std::string& muscle, int number);

}  // namespace gracilis
