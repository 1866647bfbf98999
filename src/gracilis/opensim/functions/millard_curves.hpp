#pragma once

#include <gracilis/opensim/functions/bezier_curve.hpp>

namespace gracilis::opensim {

/// What shapes the curves of a Millard2012EquilibriumMuscle, by OpenSim's names and with its defaults. Lengths are over
/// the optimal fiber length, forces over the largest isometric one, speeds over the largest.
struct MillardShape {
  Real min_norm_active_fiber_length = 0.4441, transition_norm_fiber_length = 0.73,
       max_norm_active_fiber_length = 1.8123, shallow_ascending_slope = 0.8616, minimum_value = 0;
  Real concentric_slope_at_vmax = 0, concentric_slope_near_vmax = 0.25, isometric_slope = 5,
       eccentric_slope_at_vmax = 0, eccentric_slope_near_vmax = 0.15, max_eccentric_velocity_force_multiplier = 1.4,
       concentric_curviness = 0.6, eccentric_curviness = 0.9;
  Real fiber_strain_at_zero_force = 0, fiber_strain_at_one_norm_force = 0.7, fiber_stiffness_at_low_force = 0.2,
       fiber_stiffness_at_one_norm_force = 2 / 0.7, fiber_curviness = 0.75;
  Real tendon_strain_at_one_norm_force = 0.049, tendon_stiffness_at_one_norm_force = 1.375 / 0.049,
       norm_force_at_toe_end = 2.0 / 3, tendon_curviness = 0.5;
};

/// The four curves that such a muscle is made of (Millard et al. 2013).
struct MillardCurves {
  /// By default those of a muscle that names no parameters.
  explicit MillardCurves(const MillardShape& shape = {});
  BezierCurve active;    ///< force by fiber length
  BezierCurve velocity;  ///< force by fiber speed, longer is positive
  BezierCurve passive;   ///< force by fiber length
  BezierCurve tendon;    ///< force by tendon length over its slack length
  Real shortest = 0;     ///< fibers that are shorter give no active force
};

/// What is amiss with a shape: pieces of a curve would not round a corner, or x would not increase. Empty: nothing.
const char* objection(const MillardShape& shape);

}  // namespace gracilis::opensim
