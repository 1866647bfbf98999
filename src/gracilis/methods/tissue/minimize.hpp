#pragma once

#include <gracilis/core/types.hpp>

#include <functional>
#include <span>

namespace gracilis::tissue {

/// The energy at some points and its derivative; infinite where they are not to go.
using EnergyFunction = std::function<Real(const Points&, Points& gradient)>;
/// Replaces each gradient by what a quadratic energy of about the same curvature would move by for it. Several are
/// asked for at once, since that takes hardly longer.
using MetricFunction = std::function<void(std::span<Points> gradients)>;

struct MinimizeSettings {
  int iterations = 30;
  Real residual = 0;      ///< N, root mean square over points
  Real largest_move = 0;  ///< m, of a point in one iteration
};

struct Minimized {
  int iterations = 0;
  Real energy = 0;
  Real residual = 0;  ///< N
};

/// Goes downhill by L-BFGS (Nocedal and Wright 2006, algorithm 7.4) whose first metric is given. Every accepted state
/// has less energy than the one before. Precondition: the energy at `points` is finite.
Minimized minimize(const EnergyFunction& energy, const MetricFunction& metric, const MinimizeSettings& settings,
                   Points& points);

}  // namespace gracilis::tissue
