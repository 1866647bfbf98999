#include <gracilis/view/charts/line_chart.hpp>

#include <cmath>
#include <cstdio>
#include <iostream>

/// Draws how time grows: reads lines of `size milliseconds` from stdin, in growing order, and writes a chart of both
/// logarithms beside what would be proportional to the size.
int main(int count, char** arguments) {
  using namespace gracilis;
  if (count != 4) {
    std::fprintf(stderr, "usage: gracilis_growth_chart OUT.svg TITLE WHAT_GROWS < measured\n");
    return 2;
  }
  ChartSeries measured{"measured", {}, {}, series_color(0), 2},
      proportional{"in proportion to the first", {}, {}, series_color(1), 1};
  for (Real size = 0, milliseconds = 0; std::cin >> size >> milliseconds;) {
    measured.x.push_back(std::log10(size));
    measured.y.push_back(std::log10(milliseconds));
    proportional.x.push_back(measured.x.back());
    proportional.y.push_back(measured.y.front() + measured.x.back() - measured.x.front());
  }
  if (measured.x.empty()) {
    std::fprintf(stderr, "gracilis_growth_chart: no line of `size milliseconds` on stdin; pipe the measurements in\n");
    return 3;
  }
  write_chart(arguments[1], {arguments[2],
                             "log10 of " + std::string(arguments[3]),
                             "log10 of milliseconds",
                             {std::move(proportional), std::move(measured)}});
}
