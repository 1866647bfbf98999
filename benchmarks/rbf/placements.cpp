#include "placements.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/rbf_centers.hpp>

#include <height_fields.hpp>

#include <cmath>

namespace gracilis {

namespace {

const RadialFitSettings gaussians = {{RadialShape::gaussian}, RadialPolynomial::linear, 2};

Points joined(const Points& a, const Points& b) {
  Points both(3, a.cols() + b.cols());
  both << a, b;
  return both;
}

Points filled(const Points& features, Index count, const HeightField& field) {
  return filled_up(spread_out(features, count / 2), count, field.box());
}

}  // namespace

std::vector<NamedField> height_fields() {
  return {{"four bumps (Franke 1979)", field_of(franke)},
          {"cliff", field_of([](Real x, Real y) { return std::tanh(9 * (y - x)) / 9; })},
          {"ripples", field_of([](Real x, Real y) {
             const Real u = x - 0.5, v = y - 0.5;
             return std::sin(10 * x) * std::cos(8 * y) * std::exp(-3 * (u * u + v * v));
           })}};
}

std::vector<Placement> placements() {
  return {{"grid",
           [](const HeightField& f, Index n) {
             const int side = static_cast<int>(std::lround(std::sqrt(n)));
             return grid_centers(f.box(), {side, side, 1});
           }},
          {"Halton", [](const HeightField& f, Index n) { return halton_centers(f.box(), n); }},
          {"extrema", [](const HeightField& f, Index n) { return filled(extremum_centers(f), n, f); }},
          {"inflection", [](const HeightField& f, Index n) { return filled(inflection_centers(f), n, f); }},
          {"stationary curvature", [](const HeightField& f, Index n) { return filled(curvature_centers(f), n, f); }},
          {"edges", [](const HeightField& f, Index n) { return filled(edge_centers(f), n, f); }},
          {"borders", [](const HeightField& f, Index n) { return filled(border_centers(f, 3), n, f); }},
          {"extrema, stationary curvature and borders", [](const HeightField& f, Index n) {
             const Points features = joined(extremum_centers(f), spread_out(curvature_centers(f), n / 4));
             return filled_up(joined(border_centers(f, 2), features), n, f.box());
           }}};
}

FieldFit best_fit(const HeightField& field, const Points& centers) {
  FieldFit best;
  for (const Real reach : {0.08, 0.12, 0.17, 0.25}) try {
      RadialFit fit = fit_least_squares(gaussians, centers, Eigen::VectorXd::Constant(centers.cols(), reach),
                                        field.nodes(), field.heights);
      const Real error = mean_squared_error(fit.basis, field.nodes(), field.heights);
      if (error < best.error) best = {std::move(fit), error};
    } catch (const InputError&) {
      // too wide for these centers
    }
  return best;
}

FieldFit greedy_fit(const HeightField& field, Index count) {
  FieldFit greedy;
  greedy.fit = fit_greedily(gaussians, field.nodes(), field.heights, {0.06, 0.08, 0.12, 0.17, 0.25, 0.4}, count);
  greedy.error = mean_squared_error(greedy.fit.basis, field.nodes(), field.heights);
  return greedy;
}

}  // namespace gracilis
