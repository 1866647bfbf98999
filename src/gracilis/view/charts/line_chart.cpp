#include <gracilis/view/charts/line_chart.hpp>

#include <gracilis/core/words_of_name.hpp>
#include <gracilis/io/atomic_file.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace gracilis {

namespace {

constexpr Real width = 800, height = 560, left = 80, right = 20, top = 46, bottom = 60, legend_row = 18;

struct Range {
  Real low = std::numeric_limits<Real>::infinity(), high = -low;

  void add(Real value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  /// Never empty, with a little room.
  void close(Real margin) {
    if (!(low <= high)) low = 0, high = 1;
    const Real room = high > low ? margin * (high - low) : std::max(std::abs(low), Real{1}) * 0.05;
    low -= room;
    high += room;
  }
};

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '<') {
      safe += "&lt;";
    } else if (c == '>') {
      safe += "&gt;";
    } else if (c == '&') {
      safe += "&amp;";
    } else {
      safe += c;
    }
  }
  return safe;
}

std::string hex(const Color& color) {
  const auto byte = [](Real value) { return static_cast<int>(std::lround(255 * std::clamp(value, Real{0}, Real{1}))); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(color.x()), byte(color.y()), byte(color.z()));
}

/// Named lines of a color that a named one before has are dashed, and the next ones dotted.
std::string dashes(const std::vector<ChartSeries>& all, std::size_t number) {
  if (all[number].name.empty()) return "";
  const auto repeats =
      std::count_if(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(number),
                    [&](const ChartSeries& other) { return !other.name.empty() && other.color == all[number].color; });
  return repeats == 0 ? "" : repeats == 1 ? " stroke-dasharray=\"7 3\"" : " stroke-dasharray=\"2 2\"";
}

/// A dot wherever both numbers are finite.
std::string dots_of(const ChartSeries& series, const std::function<Real(Real)>& x_of,
                    const std::function<Real(Real)>& y_of) {
  std::string dots;
  for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i)
    if (std::isfinite(series.x[i]) && std::isfinite(series.y[i]))
      dots += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:g}\" fill=\"{}\"/>\n", x_of(series.x[i]),
                          y_of(series.y[i]), series.dots, hex(series.color));
  return dots;
}

std::string text_at(Real x, Real y, const std::string& anchor, int size, const std::string& text,
                    const std::string& more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" font-size=\"{}\" {}>{}</text>\n", x, y, anchor,
                     size, more, escaped(words_of_name(text)));
}

}  // namespace

std::vector<Real> axis_ticks(Real low, Real high, int count) {
  // A range near rounding has no ticks between its ends: they could not be told apart.
  const Real size = std::max(std::abs(low), std::abs(high));
  if (!(high - low > 1e-12 * size && high - low > 1e-300 && std::isfinite(size))) return {low};
  const Real rough = (high - low) / count, power = std::pow(10, std::floor(std::log10(rough)));
  const Real share = rough / power, step = power * (share <= 1 ? 1 : share <= 2 ? 2 : share <= 5 ? 5 : 10);
  std::vector<Real> ticks;
  const Real first = std::ceil(low / step - 1e-9);
  for (int i = 0; i <= 2 * count + 2 && (first + i) * step <= high + 1e-9 * step; ++i)
    ticks.push_back((first + i) * step + 0.0);  // never -0
  return ticks;
}

std::string to_svg(const LineChart& chart) {
  Range x_range, y_range;
  std::vector<std::size_t> named;
  for (std::size_t s = 0; s < chart.series.size(); ++s) {
    for (const Real x : chart.series[s].x) x_range.add(x);
    for (const Real y : chart.series[s].y) y_range.add(y);
    if (!chart.series[s].name.empty()) named.push_back(s);
  }
  for (const Real limit : chart.limits) y_range.add(limit);
  x_range.close(0);
  y_range.close(0.04);
  const Real right_edge = width - right, bottom_edge = height - bottom;
  const auto x_of = [&](Real x) {
    return left + (x - x_range.low) / (x_range.high - x_range.low) * (right_edge - left);
  };
  const auto y_of = [&](Real y) {
    return bottom_edge - (y - y_range.low) / (y_range.high - y_range.low) * (bottom_edge - top);
  };
  constexpr int per_row = 3;
  const Real legend_height = named.size() > 1 ? legend_row * std::ceil(Real(named.size()) / per_row) + 8 : 0;

  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" font-family=\"sans-serif\" fill=\"#222\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      width, height + legend_height);
  svg += text_at(width / 2, 26, "middle", 17, chart.title, "font-weight=\"bold\"");
  for (const Real tick : axis_ticks(x_range.low, x_range.high, 10)) {
    svg += fmt::format("<line x1=\"{0:.1f}\" y1=\"{1}\" x2=\"{0:.1f}\" y2=\"{2}\" stroke=\"#e4e4e4\"/>\n", x_of(tick),
                       top, bottom_edge);
    svg += text_at(x_of(tick), bottom_edge + 18, "middle", 12, fmt::format("{:.6g}", tick));
  }
  for (const Real limit : chart.limits)
    svg += fmt::format(
        "<line x1=\"{}\" y1=\"{:.1f}\" x2=\"{}\" y2=\"{:.1f}\" stroke=\"#999\" stroke-dasharray=\"6 4\"/>\n", left,
        y_of(limit), right_edge, y_of(limit));
  for (const Real tick : axis_ticks(y_range.low, y_range.high, 8)) {
    const bool zero = std::abs(tick) < 1e-12;
    svg += fmt::format("<line x1=\"{1}\" y1=\"{0:.1f}\" x2=\"{2}\" y2=\"{0:.1f}\" stroke=\"{3}\"/>\n", y_of(tick), left,
                       right_edge, zero ? "#888" : "#e4e4e4");
    svg += text_at(left - 8, y_of(tick) + 4, "end", 12, fmt::format("{:.6g}", zero ? 0 : tick));
  }
  svg += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#444\"/>\n", left, top,
                     right_edge - left, bottom_edge - top);
  svg += text_at((left + right_edge) / 2, height - 18, "middle", 14, chart.x_label);
  svg += text_at(0, 0, "middle", 14, chart.y_label,
                 fmt::format("transform=\"translate(20 {:.1f}) rotate(-90)\"", (top + bottom_edge) / 2));

  for (std::size_t s = 0; s < chart.series.size(); ++s) {
    const ChartSeries& series = chart.series[s];
    if (series.dots > 0) {
      svg += dots_of(series, x_of, y_of);
      continue;
    }
    std::string points;
    const auto flush = [&] {
      if (!points.empty())
        svg += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"{}/>\n", points,
                           hex(series.color), series.width, dashes(chart.series, s));
      points.clear();
    };
    for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
      if (std::isfinite(series.x[i]) && std::isfinite(series.y[i])) {
        points += fmt::format("{:.1f},{:.1f} ", x_of(series.x[i]), y_of(series.y[i]));
      } else {
        flush();
      }
    }
    flush();
  }
  for (std::size_t i = 0; legend_height > 0 && i < named.size(); ++i) {
    const Real x = left + static_cast<Real>(i % per_row) * (right_edge - left) / per_row;
    const std::size_t row = i / per_row;
    const Real y = height + legend_row * static_cast<Real>(row);
    const ChartSeries& series = chart.series[named[i]];
    svg += fmt::format(
        "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" stroke-width=\"4\"{}/>\n", x,
        y + 2, x + 16, y + 2, hex(series.color), dashes(chart.series, named[i]));
    svg += text_at(x + 22, y + 6, "start", 13, series.name);
  }
  return svg + "</svg>\n";
}

void write_chart(const std::filesystem::path& path, const LineChart& chart) {
  write_text_atomically(path, to_svg(chart));
}

}  // namespace gracilis
