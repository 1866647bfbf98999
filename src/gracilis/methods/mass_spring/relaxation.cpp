#include <gracilis/methods/mass_spring/relaxation.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/core/stop.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace gracilis::mass_spring {

Real critical_damping(Real stiffness, Real mass) { return std::sqrt(4 * stiffness * mass); }

Real fitted_damping(Real mean_stiffness, Real mass) {
  return mean_stiffness > 0 ? std::sqrt(4 * (2 + 4 / mean_stiffness) * 2 * mass) : 0;
}

Real damping_of(const MassSpringSettings& settings, const SpringNet& net) {
  switch (settings.damping_rule) {
    case DampingRule::critical:
      return critical_damping(mean_stiffness(net), settings.particle_mass);
    case DampingRule::fitted:
      return fitted_damping(mean_stiffness(net), settings.particle_mass);
    case DampingRule::none:
      break;
  }
  return 0;
}

void verlet_step(const Points& forces, Real mass, Real damping, Real step, const std::vector<char>& fixed,
                 Motion& motion) {
  const Real kept = std::max(1 - damping * step / mass, Real{0}), by_force = step * step / mass;
  for (Index p = 0; p < static_cast<Index>(motion.now.cols()); ++p) {
    if (fixed[static_cast<std::size_t>(p)]) continue;
    const Vec3 now = motion.now.col(p);
    motion.now.col(p) += kept * (now - motion.before.col(p)) + by_force * forces.col(p);
    motion.before.col(p) = now;
  }
}

Real longest_step(Real force, Real moved, Real radius, Real mass, Real damping) {
  if (moved >= radius) return 0;
  const Real linear = damping * moved, room = mass * (radius - moved);
  const Real sum = linear + std::sqrt(linear * linear + 4 * force * room);
  return sum > 0 ? 2 * room / sum : std::numeric_limits<Real>::infinity();
}

namespace {

/// The longest step that no sphere of the muscle objects to.
Real longest_step_of(const RelaxedMuscle& muscle, const Points& forces) {
  Real longest = std::numeric_limits<Real>::infinity();
  for (Index p = 0; p < static_cast<Index>(forces.cols()); ++p) {
    const auto at = static_cast<std::size_t>(p);
    if (!((*muscle.radii)[at] > 0) || (*muscle.fixed)[at]) continue;
    const Real moved = (muscle.motion.now.col(p) - muscle.motion.before.col(p)).norm();
    longest =
        std::min(longest, longest_step(forces.col(p).norm(), moved, (*muscle.radii)[at], muscle.mass, muscle.damping));
  }
  return longest;
}

Real step_of(const std::vector<RelaxedMuscle>& muscles, const std::vector<Points>& forces, const RelaxationRule& rule) {
  if (!(rule.smallest_step > 0)) return rule.step;
  std::vector<Real> longest(muscles.size());
  parallel_for_each(muscles.size(), [&](std::size_t m) { longest[m] = longest_step_of(muscles[m], forces[m]); });
  const Real least = longest.empty() ? rule.step : *std::min_element(longest.begin(), longest.end());
  return std::clamp(least, std::min(rule.smallest_step, rule.step), rule.step);
}

/// Mean over the particles of all muscles, m; each muscle's own goes into it.
Real mean_displacement(const std::vector<Points>& last, std::vector<RelaxedMuscle>& muscles) {
  Real sum = 0, count = 0;
  for (std::size_t m = 0; m < muscles.size(); ++m) {
    const auto particles = static_cast<Real>(last[m].cols());
    const Real moved = particles > 0 ? (muscles[m].motion.now - last[m]).colwise().norm().sum() : 0;
    muscles[m].displacement = particles > 0 ? moved / particles : 0;
    sum += moved;
    count += particles;
  }
  return count > 0 ? sum / count : 0;
}

}  // namespace

RelaxationRule relaxation_rule(const MassSpringSettings& settings) {
  return {settings.iterations, settings.stop_displacement, settings.stop_milliseconds, settings.verlet_step,
          settings.smallest_step};
}

Relaxation relax(std::vector<RelaxedMuscle>& muscles, const RelaxationRule& rule,
                 const std::function<void()>& collide) {
  const auto started = std::chrono::steady_clock::now();
  std::vector<Points> forces(muscles.size()), last(muscles.size());
  Relaxation done;
  Real time = 0;
  while (done.iterations < rule.iterations) {
    throw_if_stopped();
    parallel_for_each(muscles.size(), [&](std::size_t m) {
      last[m] = muscles[m].motion.now;
      spring_forces(*muscles[m].net, muscles[m].motion.now, forces[m]);
    });
    const Real step = step_of(muscles, forces, rule);
    parallel_for_each(muscles.size(), [&](std::size_t m) {
      RelaxedMuscle& muscle = muscles[m];
      verlet_step(forces[m], muscle.mass, muscle.damping, step, *muscle.fixed, muscle.motion);
    });
    const bool is_finite = std::all_of(muscles.begin(), muscles.end(),
                                       [](const RelaxedMuscle& muscle) { return muscle.motion.now.allFinite(); });
    if (is_finite) collide();
    time += step;
    ++done.iterations;
    const Real displacement = mean_displacement(last, muscles);
    const std::chrono::duration<Real, std::milli> taken = std::chrono::steady_clock::now() - started;
    const bool is_still = displacement < rule.stop_displacement;
    const bool is_late = rule.stop_milliseconds > 0 && taken.count() > rule.stop_milliseconds;
    if (!is_finite || is_still || is_late) break;
  }
  done.mean_step = done.iterations > 0 ? time / done.iterations : 0;
  return done;
}

}  // namespace gracilis::mass_spring
