#include <gracilis/methods/tissue/minimize.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <vector>

namespace gracilis::tissue {

namespace {

constexpr std::size_t remembered = 8;  // pairs of moves and changes of the gradient
constexpr int step_halvings = 24;
constexpr Real sufficient_decrease = 1e-4;
/// Of the energy: differences below are rounding.
constexpr Real rounding = 1e-14;

struct Pair {
  Points move, change;
  Real curvature = 0;
};

Real dot(const Points& a, const Points& b) { return a.cwiseProduct(b).sum(); }

Real residual_of(const Points& gradient) {
  return std::sqrt(gradient.squaredNorm() / static_cast<Real>(std::max<Eigen::Index>(gradient.cols(), 1)));
}

/// The two-loop recursion.
Points descent(const std::deque<Pair>& pairs, const MetricFunction& metric, const Points& gradient) {
  std::array<Points, 2> asked = {gradient, pairs.empty() ? Points() : pairs.back().change};
  Points& q = asked[0];
  std::vector<Real> shares(pairs.size());
  for (std::size_t i = pairs.size(); i-- > 0;) {
    shares[i] = dot(pairs[i].move, q) / pairs[i].curvature;
    q -= shares[i] * pairs[i].change;
  }
  metric(std::span(asked).first(pairs.empty() ? 1 : 2));
  // So that the metric is right along the last change.
  Points direction = -q;
  if (!pairs.empty()) direction *= pairs.back().curvature / dot(pairs.back().change, asked[1]);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Real along = dot(pairs[i].change, direction) / pairs[i].curvature;
    direction -= (shares[i] + along) * pairs[i].move;
  }
  return direction;
}

}  // namespace

Minimized minimize(const EnergyFunction& energy, const MetricFunction& metric, const MinimizeSettings& settings,
                   Points& points) {
  Points gradient, next_gradient;
  Minimized done;
  done.energy = energy(points, gradient);
  done.residual = residual_of(gradient);
  std::deque<Pair> pairs;
  while (done.iterations < settings.iterations && done.residual > settings.residual) {
    Points direction = descent(pairs, metric, gradient);
    if (!(dot(direction, gradient) < 0)) {
      pairs.clear();
      direction = descent(pairs, metric, gradient);
    }
    const Real fastest = direction.colwise().norm().maxCoeff();
    if (!(fastest > 0) || !std::isfinite(fastest)) break;
    const Real slope = dot(direction, gradient);
    Real step = std::min(1.0, settings.largest_move / fastest);
    bool accepted = false;
    for (int i = 0; i < step_halvings && !accepted; ++i, step = accepted ? step : step / 2) {
      const Points next = points + step * direction;
      const Real there = energy(next, next_gradient);
      if (!(there <= done.energy + sufficient_decrease * step * slope + rounding * std::abs(done.energy))) continue;
      accepted = true;
      Pair pair{next - points, next_gradient - gradient, 0};
      pair.curvature = dot(pair.move, pair.change);
      if (pair.curvature > 1e-12 * pair.move.norm() * pair.change.norm()) pairs.push_back(std::move(pair));
      if (pairs.size() > remembered) pairs.pop_front();
      points = next;
      std::swap(gradient, next_gradient);
      done.energy = there;
    }
    ++done.iterations;
    done.residual = residual_of(gradient);
    if (accepted) continue;
    if (pairs.empty()) break;
    pairs.clear();
  }
  return done;
}

}  // namespace gracilis::tissue
