#include <gracilis/opensim/static_optimization/rigid_tendon.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis::opensim {

static bool is_thelen(const Muscle& muscle) { return muscle.type.starts_with("Thelen"); }

/// Three bells (De Groote et al. 2016, supplement).
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
  if (!is_thelen(muscle)) return smooth_length_factor(length);
  return std::exp(-(length - 1) * (length - 1) / muscle.active_shape);
}

Real force_velocity_factor(const Muscle& muscle, Real speed) {
  const Real factor = is_thelen(muscle) ? thelen_velocity_factor(speed, muscle.velocity_shape, muscle.eccentric_force)
                                        : smooth_velocity_factor(speed);
  return std::max(factor, 0.0);
}

Real rigid_tendon_force(const Muscle& muscle, Real length, Real speed) {
  const Real optimal = muscle.optimal_fiber_length, along = length - muscle.tendon_slack_length;
  const Real height = optimal * std::sin(muscle.pennation_angle_at_optimal);
  const Real least_cosine = 0.1;  // fibers do not stand steeper
  const Real fiber = std::hypot(along, height);
  if (along <= 0 || along < least_cosine * fiber || fiber < 0.01 * optimal) return 0;
  const Real cosine = along / fiber;
  const Real fiber_speed = speed * cosine / (optimal * muscle.max_contraction_velocity);
  return muscle.max_isometric_force * force_length_factor(muscle, fiber / optimal) *
         force_velocity_factor(muscle, fiber_speed) * cosine;
}

}  // namespace gracilis::opensim
