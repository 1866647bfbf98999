#include "rbf/conditions.hpp"
#include "rbf/placements.hpp"
#include "rbf/solids.hpp"

#include <gracilis/geometry/rbf_centers.hpp>
#include <gracilis/view/charts/line_chart.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

/// What Cervenka 2024 studied of radial basis functions, with this project's own: condition numbers by number of
/// functions and shape parameter, placements of centers at equal number, and what compression costs. Writes a page of
/// tables and its pictures.
namespace gracilis {

namespace {

// ---- Condition numbers

struct ShownMap {
  std::string name, title;
  ConditionMap map;
};

constexpr int least_side = 3, most_side = 16;  // of the grid: N = side²
constexpr Real least_log_alpha = -0.5, most_log_alpha = 3.5;
constexpr int alphas = 41;

Real log_alpha_of(int a) { return least_log_alpha + (most_log_alpha - least_log_alpha) * a / (alphas - 1); }

/// From dark blue (1) over green to yellow (10^16 and more).
std::string color_of(Real log_condition) {
  const Real t = std::isfinite(log_condition) ? std::clamp(log_condition / 16, 0.0, 1.0) : 1;
  const auto mix = [t](Real a, Real b, Real c) {
    return static_cast<int>(t < 0.5 ? a + (b - a) * 2 * t : b + (c - b) * (2 * t - 1));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(68, 33, 253), mix(1, 145, 231), mix(84, 140, 37));
}

void draw(const ShownMap& map, const std::string& file) {
  constexpr int cell_x = 12, cell_y = 20, left = 60, top = 40;
  const int rows = most_side - least_side + 1, width = left + cell_x * alphas + 90, height = top + cell_y * rows + 60;
  std::ofstream out(file);
  out << fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\" font-family=\"sans-serif\" "
      "font-size=\"12\">\n<text x=\"{}\" y=\"20\">{}</text>\n",
      width, height, left, map.title);
  for (int row = 0; row < rows; ++row) {
    const int side = most_side - row, y = top + row * cell_y;
    out << fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>\n", left - 8, y + 14, side * side);
    for (int a = 0; a < alphas; ++a)
      out << fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>\n", left + a * cell_x, y,
                         cell_x, cell_y, color_of(log_condition(map.map, side, log_alpha_of(a))));
  }
  const int bottom = top + rows * cell_y;
  for (int a = 0; a < alphas; a += 10)
    out << fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{:.2g}</text>\n", left + a * cell_x + cell_x / 2,
                       bottom + 18, log_alpha_of(a));
  out << fmt::format("<text x=\"{}\" y=\"{}\">log10 of the shape parameter</text>\n", left, bottom + 40);
  out << fmt::format("<text x=\"10\" y=\"{}\">N</text>\n", top - 6);
  for (int k = 0; k <= 16; k += 4) {
    const int y = bottom - 20 - k * 10, x = left + cell_x * alphas + 20;
    out << fmt::format(
        "<rect x=\"{}\" y=\"{}\" width=\"16\" height=\"40\" fill=\"{}\"/>\n<text x=\"{}\" y=\"{}\">1e{}</text>\n", x,
        y - 20, color_of(k), x + 22, y + 4, k);
  }
  out << "</svg>\n";
}

// ---- Height fields

void compare_placements(std::ostream& page) {
  constexpr Index count = 64;
  page << "\n## Placements of 64 centers\n\nMean squared error of Gaussians and a linear polynomial on 41 × 41 heights "
          "over the unit "
          "square, each placement with the best of four reaches. Features give some centers, at most half of them; the "
          "Halton "
          "sequence fills the rest. The greedy fit chooses a reach for every center.\n\n| placement |";
  for (const auto& [name, field] : height_fields()) page << ' ' << name << " |";
  page << "\n| --- | --- | --- | --- |\n";
  const auto row = [&](const std::string& name, const std::function<Real(const HeightField&)>& error) {
    page << "| " << name << " |";
    for (const auto& [field_name, field] : height_fields()) page << fmt::format(" {:.1e} |", error(field));
    page << '\n';
  };
  for (const Placement& placement : placements())
    row(placement.name, [&](const HeightField& f) { return best_fit(f, placement.centers(f, count)).error; });
  row("greedy", [](const HeightField& f) { return greedy_fit(f, count).error; });
}

// ---- Compression

/// Adds a point of a share and the logarithm of an error to a chart's line.
void add_point(Real share, Real error, ChartSeries& series) {
  series.x.push_back(100 * share);
  series.y.push_back(std::log10(error));
}

/// Writes a chart beside the page, and shows it there.
void show(const LineChart& chart, const std::string& docs, const std::string& name, std::ostream& page) {
  write_chart(docs + "/pictures/" + name + ".svg", chart);
  page << fmt::format("\n![{}](pictures/{}.svg)\n", chart.title, name);
}

void compress_fields(const std::string& docs, std::ostream& page) {
  page << "\nNo placement is best on all fields. What features suggest helps where they are what the field is made of "
          "(extrema of bumps), and costs where they leave other places bare or stand so close that their functions "
          "hardly "
          "differ (inflection along the cliff). The greedy fit beats a grid of equal functions on bumps only.\n";
  page << "\n## Compression of height fields\n\nMean squared error by the share of the 1681 heights that are kept as "
          "centers; Halton "
          "sequence, and greedy up to 5 %.\n\n| field | 1 % | 2.5 % | 5 % | 10 % | greedy 1 % | greedy 2.5 % | greedy "
          "5 % |\n"
          "| --- | --- | --- | --- | --- | --- | --- | --- |\n";
  LineChart chart{"Compression of height fields",
                  "share of the heights that are centers, %",
                  "log10 of the mean squared error",
                  {}};
  int number = 0;
  for (const auto& [name, field] : height_fields()) {
    const Color color = series_color(number++);
    const std::string in_short = name.substr(0, name.find(" ("));
    ChartSeries halton{in_short + ", Halton", {}, {}, color, 2}, greedy{in_short + ", greedy", {}, {}, color, 2};
    page << "| " << name << " |";
    for (const Index count : {17, 42, 84, 168}) {
      const Real error = best_fit(field, halton_centers(field.box(), count)).error;
      add_point(count / Real{1681}, error, halton);
      page << fmt::format(" {:.1e} |", error);
    }
    for (const Index count : {17, 42, 84}) {
      const Real error = greedy_fit(field, count).error;
      add_point(count / Real{1681}, error, greedy);
      page << fmt::format(" {:.1e} |", error);
    }
    page << '\n';
    chart.series.push_back(std::move(halton));
    chart.series.push_back(std::move(greedy));
  }
  show(chart, docs, "rbf_compression_heights", page);
}

void compress_muscle(const std::string& docs, std::ostream& page) {
  const TriangleMesh muscle = builtin_gluteus();
  page << fmt::format(
      "\n## Compression of a muscle\n\ngluteus_maximus_r of the built-in hip ({} vertices) as thin plates, by the "
      "share of its "
      "vertices "
      "that are centers; extracted at 3 mm.\n\n| centers | share | volume error | Hausdorff distance | condition "
      "number |\n"
      "| --- | --- | --- | --- | --- |\n",
      muscle.vertex_count());
  ChartSeries by_volume{"volume error, %", {}, {}, series_color(0), 2},
      by_distance{"Hausdorff distance, mm", {}, {}, series_color(1), 2};
  for (const Real share : {0.025, 0.05, 0.1, 0.2}) {
    const SolidErrors errors = solid_errors(muscle, static_cast<Index>(share * muscle.vertex_count()), 0.003);
    add_point(share, 100 * errors.volume, by_volume);
    add_point(share, 1000 * errors.hausdorff, by_distance);
    page << fmt::format("| {} | {:.1f} % | {:.2f} % | {:.1f} mm | {:.1e} |\n", errors.centers, 100 * share,
                        100 * errors.volume, 1000 * errors.hausdorff, errors.condition);
  }
  show({"Compression of a muscle",
        "share of the vertices that are centers, %",
        "log10 of % or mm",
        {by_volume, by_distance}},
       docs, "rbf_compression_muscle", page);
}

}  // namespace

}  // namespace gracilis

int main(int count, char** arguments) {
  using namespace gracilis;
  if (count != 2) {
    std::cerr << "usage: gracilis_rbf_study DOCS_FOLDER\n";
    return 2;
  }
  const std::string docs = arguments[1];
  std::ofstream page(docs + "/radial-basis-functions.md");
  page << "# Radial basis functions in numbers\n\nWritten by `benchmarks/rbf_study.cpp` (`gracilis_rbf_study docs`). "
          "What Cervenka 2024 "
          "(sections 5.1 to 5.7) studied, with this project's kernels and solvers.\n\n## Condition numbers\n\nOf "
          "interpolation on "
          "the unit square by N Gaussians exp(-α r²), α the shape parameter, or thin plates of r √α, in the 1-norm.\n";
  const std::vector<ShownMap> maps = {
      {"rbf_condition_grid", "Gaussians on a grid: condition number", {RadialShape::gaussian, true}},
      {"rbf_condition_halton", "Gaussians on the Halton sequence: condition number", {RadialShape::gaussian, false}},
      {"rbf_condition_thin_plate",
       "Thin plates on the Halton sequence: condition number",
       {RadialShape::thin_plate, false}}};
  for (const ShownMap& map : maps) {
    draw(map, docs + "/pictures/" + map.name + ".svg");
    page << fmt::format("\n![{}](pictures/{}.svg)\n", map.title, map.name);
  }
  page << "\n| N, log10 α | grid | Halton | thin plates |\n| --- | --- | --- | --- |\n";
  for (const int side : {5, 10, 15})
    for (const int a : {15, 25, 35}) {
      page << fmt::format("| {}, {:.1f} |", side * side, log_alpha_of(a));
      for (const ShownMap& map : maps)
        page << fmt::format(" {:.1e} |", std::pow(10, log_condition(map.map, side, log_alpha_of(a))));
      page << '\n';
    }
  page << "\nWith one reach for all, narrow Gaussians (α large) give good systems and wide ones systems without a "
          "digit, on "
          "both placements; the Halton sequence, whose nearest points are closer than a grid's, is the worse one for "
          "narrow "
          "functions, unlike what the report says. Thin plates hardly depend on the shape parameter, but for one (on "
          "the Halton sequence two, close to each other) at which their matrix is singular and that these tables miss: "
          "reproductions/cervenka-2024.\n";
  compare_placements(page);
  compress_fields(docs, page);
  compress_muscle(docs, page);
}
