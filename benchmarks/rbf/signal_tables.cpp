#include "tables.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/radial_fit.hpp>
#include <gracilis/geometry/rbf_centers.hpp>

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace gracilis {

namespace {

constexpr int samples = 201;

struct Signal {
  std::string name;
  Real (*height)(Real x);
};

/// Each is hard for some function: smooth, of two scales, of a growing frequency, steep, with a pole nearby, with a
/// kink.
const std::vector<Signal> signals = {
    {"wave", [](Real x) { return std::sin(2 * pi * x); }},
    {"two waves", [](Real x) { return std::sin(4 * pi * x) + 0.3 * std::sin(14 * pi * x); }},
    {"chirp", [](Real x) { return std::sin(20 * x * x); }},
    {"step", [](Real x) { return std::tanh(20 * (x - 0.45)); }},
    {"Runge", [](Real x) { return 1 / (1 + 25 * (2 * x - 1) * (2 * x - 1)); }},
    {"kink", [](Real x) { return std::abs(x - 0.37); }}};

struct Sampled {
  Points points = Points::Zero(3, samples);
  Eigen::VectorXd heights = Eigen::VectorXd(samples);

  explicit Sampled(const Signal& signal) {
    for (Index i = 0; i < samples; ++i) {
      points(0, i) = static_cast<Real>(i) / (samples - 1);
      heights[i] = signal.height(points(0, i));
    }
  }
  /// Of the signal's variance.
  Real percent(Real mean_squared) const {
    return 100 * mean_squared / ((heights.array() - heights.mean()).square().mean());
  }
};

/// Ends, extrema and inflections, at most half of the count, the rest from the Halton sequence.
Points feature_centers(const Sampled& signal, Index count) {
  const Eigen::VectorXd& h = signal.heights;
  Points ends = Points::Zero(3, 2), features(3, 0);
  ends(0, 1) = 1;
  const auto bend = [&](Index i) { return h[i - 1] - 2 * h[i] + h[i + 1]; };
  for (Index i = 2; i + 2 < samples; ++i) {
    const bool is_extremum = (h[i] - h[i - 1]) * (h[i + 1] - h[i]) < 0;
    const bool is_inflection = bend(i) * bend(i + 1) < 0;
    if (!is_extremum && !is_inflection) continue;
    features.conservativeResize(3, features.cols() + 1);
    features.rightCols(1) = signal.points.col(i);
  }
  Points given(3, 2 + features.cols());
  given << ends, features;
  const Eigen::AlignedBox3d box(Vec3::Zero(), Vec3(1, 0, 0));
  return filled_up(spread_out(given, count / 2), count, box);
}

struct Trial {
  Real reach = 1, exponent = 0, percent = std::numeric_limits<Real>::infinity(), condition = 0;
};

/// The reach, and of the proposed function the exponent, that leaves least.
Trial best_of(RadialShape shape, const Sampled& signal, const Points& centers) {
  const bool is_power = shape == RadialShape::power_minus_1, has_reach = !is_power && shape != RadialShape::thin_plate;
  const std::vector<Real> reaches = !has_reach                       ? std::vector<Real>{1}
                                    : shape == RadialShape::gaussian ? std::vector<Real>{0.03, 0.05, 0.08, 0.12, 0.2}
                                                                     : std::vector<Real>{0.1, 0.2, 0.4, 0.8, 1.6};
  const std::vector<Real> exponents = is_power ? std::vector<Real>{0.5, 1.3, 1.8, 2.5, 3.5} : std::vector<Real>{0};
  Trial best;
  for (const Real reach : reaches)
    for (const Real exponent : exponents) try {
        const RadialFit fit =
            fit_least_squares({{shape, exponent}, RadialPolynomial::linear, 1}, centers,
                              Eigen::VectorXd::Constant(centers.cols(), reach), signal.points, signal.heights);
        const Real percent = signal.percent(mean_squared_error(fit.basis, signal.points, signal.heights));
        if (percent < best.percent) best = {reach, exponent, percent, fit.condition};
      } catch (const InputError&) {
        // singular to working precision
      }
  return best;
}

/// Interpolation at Halton's points by the proposed function with one exponent after the other.
void sweep_exponents(const TableRequest& request) {
  constexpr Index count = 20;
  std::ofstream exponents = request.table("exponents", "signal,exponent,percent,log_condition");
  const Points centers = halton_centers({Vec3::Zero(), Vec3(1, 0, 0)}, count);
  const int per_unit = request.thin ? 4 : 20;  // whole numbers are among them
  for (const std::size_t s : {0U, 3U}) {
    const Sampled signal(signals[s]);
    Eigen::VectorXd values(count);
    for (Index i = 0; i < count; ++i) values[i] = signals[s].height(centers(0, i));
    for (int i = 1; 2 * i <= 13 * per_unit; ++i) {
      const Real exponent = static_cast<Real>(i) / per_unit;
      const RadialFitSettings settings = {{RadialShape::power_minus_1, exponent}, RadialPolynomial::none, 1};
      const Real condition = interpolation_condition(settings, centers, 1);
      std::string percent;
      try {
        const RadialFit fit = interpolate(settings, centers, 1, values);
        percent = fmt::format("{:.6g}", signal.percent(mean_squared_error(fit.basis, signal.points, signal.heights)));
      } catch (const InputError&) {
        // singular: there is no error to tell
      }
      exponents << fmt::format("{},{:.4g},{},{:.6g}\n", signals[s].name, exponent, percent, std::log10(condition));
    }
  }
}

}  // namespace

void write_signals(const TableRequest& request) {
  constexpr Index count = 20;
  constexpr auto names = choices_of(RadialShape{});
  std::ofstream table = request.table("signals", "signal,kernel,reach,exponent,percent,condition");
  std::ofstream curves = request.table("signal_curves", "signal,x,height");
  for (const Signal& each : signals) {
    const Sampled signal(each);
    const Points centers = feature_centers(signal, count);
    for (Index i = 0; i < samples; ++i)
      curves << fmt::format("{},{:.4g},{:.6g}\n", each.name, signal.points(0, i), signal.heights[i]);
    for (std::size_t k = 0; k < names.size(); ++k) {
      const Trial best = best_of(static_cast<RadialShape>(k), signal, centers);
      table << fmt::format("{},{},{:.3g},{:.3g},{:.4g},{:.3g}\n", each.name, names[k], best.reach, best.exponent,
                           best.percent, best.condition);
    }
  }
  sweep_exponents(request);
}

}  // namespace gracilis
