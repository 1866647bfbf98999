#pragma once

#include <gracilis/io/tables/table.hpp>
#include <gracilis/scene/scene.hpp>
#include <gracilis/view/charts/line_chart.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gracilis {

/// A coordinate as charts show it.
struct ChartCoordinate {
  std::string name;   ///< of its column
  Real factor = 1;    ///< from what tables have (degrees, m) to what is shown
  std::string label;  ///< with the unit that is shown
};

/// A coordinate of the scene: in degrees, or in mm where it is a translation.
ChartCoordinate chart_coordinate(const Scene& scene, const std::string& name);

/// One muscle's columns of a table (its own name for the mean, `<muscle>_f000` ... for the fibers) against the
/// coordinate's: one thin line per fiber and a thick one for the mean, values in mm.
LineChart fiber_chart(const Table& table, const ChartCoordinate& coordinate, const std::string& muscle,
                      const std::string& title, const std::string& y_label);

/// The means of all muscles in one chart.
LineChart muscles_chart(const Table& table, const ChartCoordinate& coordinate, const std::vector<std::string>& muscles,
                        const std::string& title, const std::string& y_label);

/// The coordinate whose column changes most, a degree against a mm; empty when the table has no column of the scene's
/// coordinates.
std::string main_coordinate(const Table& table, const Scene& scene);

/// Writes RUN/plots: `fiber_lengths_<muscle>.svg` against the main coordinate where the run has fiber lengths, and
/// volume.svg, edges.svg and angles.svg, the changes of volume, of mean edge length and of dihedral angles against the
/// frame.
void write_run_charts(const std::filesystem::path& run_folder, const Scene& scene);

}  // namespace gracilis
