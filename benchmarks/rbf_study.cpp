#include <gracilis/anatomy/builtin/builtin_hip.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/nearest_triangle.hpp>
#include <gracilis/geometry/radial_solid.hpp>
#include <gracilis/geometry/rbf_centers.hpp>
#include <gracilis/geometry/rbf_feature_centers.hpp>
#include <gracilis/geometry/surface_extraction.hpp>
#include <gracilis/view/charts/line_chart.hpp>

#include <height_fields.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <iostream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

/// What Cervenka 2024 studied of radial basis functions, with this project's own: condition numbers by number of
/// functions and shape parameter, placements of centers at equal number, and what compression costs. Writes a page of
/// tables and its pictures.
namespace gracilis {

namespace {

const Eigen::AlignedBox3d unit_square(Vec3::Zero(), Vec3(1, 1, 0));

// ---- Condition numbers

struct ConditionMap {
  std::string name, title;
  RadialShape shape = RadialShape::gaussian;
  bool is_grid = true;
};

constexpr int least_side = 3, most_side = 16;  // of the grid: N = side²
constexpr Real least_log_alpha = -0.5, most_log_alpha = 3.5;
constexpr int alphas = 41;

Real log_condition(const ConditionMap& map, int side, int a) {
  const Points points =
      map.is_grid ? grid_centers(unit_square, {side, side, 1}) : halton_centers(unit_square, side * side);
  const Real log_alpha = least_log_alpha + (most_log_alpha - least_log_alpha) * a / (alphas - 1);
  return std::log10(
      interpolation_condition({{map.shape}, RadialPolynomial::none, 2}, points, std::pow(10, -log_alpha / 2)));
}

/// From dark blue (1) over green to yellow (10^16 and more).
std::string color_of(Real log_condition) {
  const Real t = std::isfinite(log_condition) ? std::clamp(log_condition / 16, 0.0, 1.0) : 1;
  const auto mix = [t](Real a, Real b, Real c) {
    return static_cast<int>(t < 0.5 ? a + (b - a) * 2 * t : b + (c - b) * (2 * t - 1));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(68, 33, 253), mix(1, 145, 231), mix(84, 140, 37));
}

void draw(const ConditionMap& map, const std::string& file) {
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
                         cell_x, cell_y, color_of(log_condition(map, side, a)));
  }
  const int bottom = top + rows * cell_y;
  for (int a = 0; a < alphas; a += 10)
    out << fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{:.2g}</text>\n", left + a * cell_x + cell_x / 2,
                       bottom + 18, least_log_alpha + (most_log_alpha - least_log_alpha) * a / (alphas - 1));
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

Real square(Real x) { return x * x; }

std::vector<std::pair<std::string, HeightField>> fields() {
  return {{"four bumps (Franke 1979)", field_of(franke)},
          {"cliff", field_of([](Real x, Real y) { return std::tanh(9 * (y - x)) / 9; })},
          {"ripples", field_of([](Real x, Real y) {
             return std::sin(10 * x) * std::cos(8 * y) * std::exp(-3 * (square(x - 0.5) + square(y - 0.5)));
           })}};
}

/// The least mean squared error over some reaches; the one Gaussian reach that is best for all centers together.
Real best_error(const HeightField& field, const Points& centers) {
  Real best = std::numeric_limits<Real>::infinity();
  for (const Real reach : {0.08, 0.12, 0.17, 0.25}) try {
      const RadialFit fit =
          fit_least_squares({{RadialShape::gaussian}, RadialPolynomial::linear, 2}, centers,
                            Eigen::VectorXd::Constant(centers.cols(), reach), field.nodes(), field.heights);
      best = std::min(best, mean_squared_error(fit.basis, field.nodes(), field.heights));
    } catch (const InputError&) {
      // too wide for these centers
    }
  return best;
}

Points joined(const Points& a, const Points& b) {
  Points both(3, a.cols() + b.cols());
  both << a, b;
  return both;
}

const std::vector<Real> greedy_reaches = {0.06, 0.08, 0.12, 0.17, 0.25, 0.4};

Real greedy_error(const HeightField& field, Index count) {
  const RadialFit fit = fit_greedily({{RadialShape::gaussian}, RadialPolynomial::linear, 2}, field.nodes(),
                                     field.heights, greedy_reaches, count);
  return mean_squared_error(fit.basis, field.nodes(), field.heights);
}

void compare_placements(std::ostream& page) {
  constexpr Index count = 64;
  page << "\n## Placements of 64 centers\n\nMean squared error of Gaussians and a linear polynomial on 41 × 41 heights "
          "over the unit "
          "square, each placement with the best of four reaches. Features give some centers, at most half of them; the "
          "Halton "
          "sequence fills the rest. The greedy fit chooses a reach for every center.\n\n| placement |";
  for (const auto& [name, field] : fields()) page << ' ' << name << " |";
  page << "\n| --- | --- | --- | --- |\n";
  const auto filled = [](const Points& features, const HeightField& field) {
    return filled_up(spread_out(features, count / 2), count, field.box());
  };
  const std::vector<std::pair<std::string, std::function<Real(const HeightField&)>>> placements = {
      {"grid",
       [](const HeightField& f) {
         return best_error(f, grid_centers(f.box(), {8, 8, 1}));
       }},
      {"Halton", [](const HeightField& f) { return best_error(f, halton_centers(f.box(), count)); }},
      {"extrema", [&](const HeightField& f) { return best_error(f, filled(extremum_centers(f), f)); }},
      {"inflection", [&](const HeightField& f) { return best_error(f, filled(inflection_centers(f), f)); }},
      {"stationary curvature", [&](const HeightField& f) { return best_error(f, filled(curvature_centers(f), f)); }},
      {"edges", [&](const HeightField& f) { return best_error(f, filled(edge_centers(f), f)); }},
      {"borders", [&](const HeightField& f) { return best_error(f, filled(border_centers(f, 3), f)); }},
      {"extrema, stationary curvature and borders",
       [&](const HeightField& f) {
         const Points features = joined(extremum_centers(f), spread_out(curvature_centers(f), 16));
         return best_error(f, filled_up(joined(border_centers(f, 2), features), count, f.box()));
       }},
      {"greedy", [](const HeightField& f) { return greedy_error(f, count); }}};
  for (const auto& [name, error] : placements) {
    page << "| " << name << " |";
    for (const auto& [field_name, field] : fields()) page << fmt::format(" {:.1e} |", error(field));
    page << '\n';
  }
}

// ---- Compression

Real farthest(const TriangleMesh& from, const TriangleMesh& to) {
  const NearestTriangle nearest(to);
  Real distance = 0;
  for (Index v = 0; v < from.vertex_count(); ++v)
    distance = std::max(distance, nearest.query(from.vertices.col(v)).distance);
  return distance;
}

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
  for (const auto& [name, field] : fields()) {
    const Color color = muscle_color(number++, Palette::okabe_ito);
    const std::string in_short = name.substr(0, name.find(" ("));
    ChartSeries halton{in_short + ", Halton", {}, {}, color, 2}, greedy{in_short + ", greedy", {}, {}, color, 2};
    page << "| " << name << " |";
    for (const Index count : {17, 42, 84, 168}) {
      const Real error = best_error(field, halton_centers(field.box(), count));
      add_point(count / Real{1681}, error, halton);
      page << fmt::format(" {:.1e} |", error);
    }
    for (const Index count : {17, 42, 84}) {
      const Real error = greedy_error(field, count);
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
  const Scene scene = builtin_hip();
  const auto found_muscle = std::find_if(scene.muscles.begin(), scene.muscles.end(),
                                         [](const Muscle& each) { return each.name == "gluteus_maximus_r"; });
  const TriangleMesh& muscle = found_muscle->surface;
  page << fmt::format(
      "\n## Compression of a muscle\n\n{} of the built-in hip ({} vertices) as thin plates, by the share of its "
      "vertices "
      "that are centers; extracted at 3 mm.\n\n| centers | share | volume error | Hausdorff distance | condition "
      "number |\n"
      "| --- | --- | --- | --- | --- |\n",
      found_muscle->name, muscle.vertex_count());
  const Real volume = enclosed_volume(muscle.vertices, muscle.faces);
  ChartSeries by_volume{"volume error, %", {}, {}, muscle_color(0, Palette::okabe_ito), 2},
      by_distance{"Hausdorff distance, mm", {}, {}, muscle_color(1, Palette::okabe_ito), 2};
  for (const Real share : {0.025, 0.05, 0.1, 0.2}) {
    RadialSolidSettings settings;
    settings.centers = static_cast<Index>(share * muscle.vertex_count());
    const RadialSolid solid = fit_solid(muscle, settings);
    const TriangleMesh found = largest_component(extract_surface(sample(implicit_solid(solid), 0.003)));
    const Real error = 100 * std::abs(enclosed_volume(found.vertices, found.faces) / volume - 1);
    const Real distance = 1000 * std::max(farthest(found, muscle), farthest(muscle, found));
    add_point(share, error, by_volume);
    add_point(share, distance, by_distance);
    page << fmt::format("| {} | {:.1f} % | {:.2f} % | {:.1f} mm | {:.1e} |\n", settings.centers, 100 * share, error,
                        distance, solid.fit.condition);
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
  const std::vector<ConditionMap> maps = {
      {"rbf_condition_grid", "Gaussians on a grid: condition number", RadialShape::gaussian, true},
      {"rbf_condition_halton", "Gaussians on the Halton sequence: condition number", RadialShape::gaussian, false},
      {"rbf_condition_thin_plate", "Thin plates on the Halton sequence: condition number", RadialShape::thin_plate,
       false}};
  for (const ConditionMap& map : maps) {
    draw(map, docs + "/pictures/" + map.name + ".svg");
    page << fmt::format("\n![{}](pictures/{}.svg)\n", map.title, map.name);
  }
  page << "\n| N, log10 α | grid | Halton | thin plates |\n| --- | --- | --- | --- |\n";
  for (const int side : {5, 10, 15})
    for (const int a : {15, 25, 35})
      page << fmt::format("| {}, {:.1f} | {:.1e} | {:.1e} | {:.1e} |\n", side * side,
                          least_log_alpha + (most_log_alpha - least_log_alpha) * a / (alphas - 1),
                          std::pow(10, log_condition(maps[0], side, a)), std::pow(10, log_condition(maps[1], side, a)),
                          std::pow(10, log_condition(maps[2], side, a)));
  page << "\nWith one reach for all, narrow Gaussians (α large) give good systems and wide ones systems without a "
          "digit, on "
          "both placements; the Halton sequence, whose nearest points are closer than a grid's, is the worse one for "
          "narrow "
          "functions, unlike what the report says. Thin plates hardly depend on the shape parameter.\n";
  compare_placements(page);
  compress_fields(docs, page);
  compress_muscle(docs, page);
}
