#pragma once

#include <gracilis/view/pictures/palette.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gracilis {

/// One line of a chart.
struct ChartSeries {
  std::string name;  ///< appears in the legend; empty: not in the legend
  std::vector<Real> x, y;
  Color color = Color::Zero();
  Real width = 1;  ///< pixels
  Real dots = 0;   ///< pixels, the radius of dots in place of a line; 0: a line
};

/// Lines over a common axis, as people draw them in this field.
struct LineChart {
  std::string title, x_label, y_label;
  std::vector<ChartSeries> series;
  std::vector<Real> limits = {};  ///< values of y that are shown as lines across, however far off the series are
};

/// The chart as .svg: needs neither a display nor OpenGL. Values that are not finite interrupt their line.
std::string to_svg(const LineChart& chart);

/// Writes it, whole or not at all. Throws InputError.
void write_chart(const std::filesystem::path& path, const LineChart& chart);

/// Round numbers from within [low, high], at most about `count`, for an axis.
std::vector<Real> axis_ticks(Real low, Real high, int count);

}  // namespace gracilis
