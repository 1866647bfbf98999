#include <gracilis/opensim/static_optimization/muscle_curves.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis::opensim {

/// Three bells (De Groote et al. 2016, supplement), whose height at 1 is 1.
static Real smooth_length_factor(Real length) {
  const Real height[3] = {0.8150671134243542, 0.433004984392647, 0.1};
  const Real center[3] = {1.055033428970575, 0.716775413397760, 1};
  const Real width[3] = {0.162384573599574, -0.029947116970696, 0.353553390593274};
  const Real growth[3] = {0.063303448465465, 0.200356847296188, 0};
  Real sum = 0;
  for (int i = 0; i < 3; ++i) {
    const Real off = (length - center[i]) / (width[i] + growth[i] * length);
    sum += height[i] * std::exp(-0.5 * off * off);
  }
  return sum;
}

static Real smooth_velocity_factor(Real speed) {
  return -0.3211346127989808 * std::asinh(-8.149 * speed - 0.374) + 0.8825327733249912;
}

/// Thelen (2003), eqs. 6 and 7, at full activation, solved for the force; straight beyond 95 % of the largest force of
/// a muscle being stretched.
static Real thelen_velocity_factor(Real speed, Real shape, Real largest) {
  if (speed <= 0) return (1 + speed) / (1 - speed / shape);
  const Real k = (2 + 2 / shape) / (largest - 1), last = 0.95 * largest, steep = k * (largest - last);
  const Real last_speed = (last - 1) / steep;
  if (speed <= last_speed) return (1 + speed * k * largest) / (1 + speed * k);
  return last + (speed - last_speed) / (1 / steep + (last - 1) * k / (steep * steep));
}

Real force_length_factor(const Muscle& muscle, Real length) {
  switch (curves_of(muscle)) {
    case MuscleCurves::thelen:
      return std::exp(-(length - 1) * (length - 1) / muscle.active_shape);
    case MuscleCurves::millard:
      return value(muscle.millard.active, length);
    case MuscleCurves::de_groote:
      break;
  }
  return smooth_length_factor((length - 1) / muscle.active_width + 1);
}

Real force_velocity_factor(const Muscle& muscle, Real speed, Real activation) {
  Real factor = 0;
  switch (curves_of(muscle)) {
    case MuscleCurves::thelen:  // its largest speed grows with activation
      factor =
          thelen_velocity_factor(speed / (0.25 + 0.75 * activation), muscle.velocity_shape, muscle.eccentric_force);
      break;
    case MuscleCurves::millard:
      factor = value(muscle.millard.velocity, speed);
      break;
    case MuscleCurves::de_groote:
      factor = smooth_velocity_factor(speed);
      break;
  }
  return std::max(factor, 0.0);
}

Real passive_factor(const Muscle& muscle, Real length) {
  if (muscle.ignore_passive_force) return 0;
  if (curves_of(muscle) == MuscleCurves::millard) return value(muscle.millard.passive, length);
  const Real rate = muscle.passive_shape / muscle.fiber_strain;
  const bool thelen = curves_of(muscle) == MuscleCurves::thelen;
  const Real zero = thelen ? 1 : std::exp(rate * (0.2 - 1));  // OpenSim lets De Groote's begin at 0.2
  return std::max((std::exp(rate * (length - 1)) - zero) / (std::exp(muscle.passive_shape) - zero), 0.0);
}

/// Thelen (2003), fig. 5: exponential up to a third of the largest force, straight from there on, as smoothly.
static Real thelen_tendon_factor(Real strain, Real strain_at_one) {
  const Real toe_shape = 3, toe_force = 0.33, e = std::exp(toe_shape);
  const Real toe_strain = 99 * strain_at_one * e / (166 * e - 67);
  if (strain > toe_strain) return toe_force + (1 - toe_force) * (strain - toe_strain) / (strain_at_one - toe_strain);
  return strain > 0 ? toe_force * (std::exp(toe_shape * strain / toe_strain) - 1) / (e - 1) : 0;
}

Real tendon_factor(const Muscle& muscle, Real length) {
  switch (curves_of(muscle)) {
    case MuscleCurves::thelen:
      return thelen_tendon_factor(length - 1, muscle.tendon_strain);
    case MuscleCurves::millard:
      return value(muscle.millard.tendon, length);
    case MuscleCurves::de_groote:
      break;
  }
  const Real least = 0.2;  // c_1 and c_3, which OpenSim has alike; its c_2 is 1
  return std::max(least * (std::exp(std::log((1 + least) / least) * (length - 1) / muscle.tendon_strain) - 1), 0.0);
}

FiberGeometry::FiberGeometry(const Muscle& muscle)
    : height(muscle.optimal_fiber_length * std::sin(muscle.pennation_angle_at_optimal)) {
  const Real steepest = std::sin(muscle.max_pennation_angle), optimal = muscle.optimal_fiber_length;
  shortest = std::max(steepest > 1e-9 ? height / steepest : 0, 0.01 * optimal);
  if (curves_of(muscle) == MuscleCurves::millard) shortest = std::max(shortest, muscle.millard.shortest * optimal);
}

Real FiberGeometry::along(Real fiber) const { return std::sqrt(std::max(fiber * fiber - height * height, 0.0)); }

}  // namespace gracilis::opensim
