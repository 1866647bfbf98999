#pragma once

#include <gracilis/io/table.hpp>
#include <gracilis/scene/scene.hpp>
#include <gracilis/view/line_chart.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gracilis {

/// One muscle's columns of a table (its own name for the mean, `<muscle>_f000` ... for the fibers) against the column
/// `coordinate` (degrees): one thin line per fiber and a thick one for the mean, values in mm.
LineChart fiber_chart(const Table& table, const std::string& coordinate, const std::string& muscle,
                      const std::string& title, const std::string& y_label);

/// The means of all muscles in one chart.
LineChart muscles_chart(const Table& table, const std::string& coordinate, const std::vector<std::string>& muscles,
                        const std::string& title, const std::string& y_label);

/// The coordinate whose column changes most; empty when the table has no column of the scene's coordinates.
std::string main_coordinate(const Table& table, const Scene& scene);

/// Writes RUN/plots: fiber_lengths_<muscle>.svg against the main coordinate where the run has fiber lengths, and
/// volume.svg and edges.svg, the changes of volume and of mean edge length against the frame.
void write_run_charts(const std::filesystem::path& run_folder, const Scene& scene);

}  // namespace gracilis
