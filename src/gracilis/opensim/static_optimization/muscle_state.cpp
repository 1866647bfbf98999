#include <gracilis/opensim/static_optimization/muscle_state.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis::opensim {

namespace {

/// A muscle on a path of given length, its forces over the largest isometric one.
struct PulledMuscle {
  const Muscle& muscle;
  Real activation, length;
  FiberGeometry fibers;

  /// Of fibers of this length (m) and speed (over the largest one), along the tendon.
  Real fiber_force(Real fiber, Real speed) const {
    const Real normal = fiber / muscle.optimal_fiber_length;
    const Real force =
        activation * force_length_factor(muscle, normal) * force_velocity_factor(muscle, speed, activation) +
        passive_factor(muscle, normal) + muscle.fiber_damping * speed;
    return std::max(force, 0.0) * fibers.cosine(fiber);
  }
  Real tendon_force(Real fiber) const {
    return tendon_factor(muscle, (length - fibers.along(fiber)) / muscle.tendon_slack_length);
  }
};

/// Where f, which is below zero at `low` and not at `high`, becomes zero.
template <class F>
Real root_between(Real low, Real high, const F& f) {
  Real at_low = f(low), at_high = f(high);
  if (at_low >= 0) return low;
  for (int i = 0; i < 100 && high - low > 1e-13 * high; ++i) {
    // The secant by turns with the middle: quick on smooth functions, and never slow on others.
    const Real secant = low - at_low * (high - low) / (at_high - at_low);
    const Real x = i % 3 < 2 && secant > low && secant < high ? secant : (low + high) / 2;
    const Real y = f(x);
    (y < 0 ? low : high) = x;
    (y < 0 ? at_low : at_high) = y;
    if (y == 0) return x;
  }
  return (low + high) / 2;
}

}  // namespace

static MuscleState rigid_state(const PulledMuscle& pulled, Real speed) {
  const Muscle& muscle = pulled.muscle;
  const Real along = pulled.length - muscle.tendon_slack_length, fiber = std::hypot(along, pulled.fibers.height);
  if (along <= 0 || fiber <= pulled.fibers.shortest) return {0, pulled.fibers.shortest, 0};
  const Real fiber_speed = speed * along / fiber,
             largest = muscle.optimal_fiber_length * muscle.max_contraction_velocity;
  return {muscle.max_isometric_force * pulled.fiber_force(fiber, fiber_speed / largest), fiber, fiber_speed};
}

/// The part of a path's speed that fibers take: the softer of two springs in series moves more.
static Real fiber_share(const PulledMuscle& pulled, Real fiber, Real speed) {
  const Real step = 1e-6 * pulled.muscle.optimal_fiber_length;
  const Real before = fiber - step, after = fiber + step;
  const Real way = pulled.fibers.along(after) - pulled.fibers.along(before);
  const Real of_fiber = (pulled.fiber_force(after, speed) - pulled.fiber_force(before, speed)) / way;
  const Real of_tendon = -(pulled.tendon_force(after) - pulled.tendon_force(before)) / way;
  const Real sum = of_fiber + of_tendon;
  return of_tendon > 0 && sum > 1e-9 * of_tendon ? std::clamp(of_tendon / sum, 0.0, 2.0) : 0;
}

static MuscleState elastic_state(const PulledMuscle& pulled, Real path_speed) {
  const Muscle& muscle = pulled.muscle;
  const FiberGeometry& fibers = pulled.fibers;
  const Real slack = pulled.length - muscle.tendon_slack_length;  // along the tendon
  if (slack <= fibers.along(fibers.shortest)) return {0, fibers.shortest, 0};
  const Real longest = std::hypot(slack, fibers.height);
  const Real largest = muscle.optimal_fiber_length * muscle.max_contraction_velocity;
  Real speed = 0, fiber = longest;
  for (int i = 0; i < 40; ++i) {
    fiber = root_between(fibers.shortest, longest,
                         [&](Real x) { return pulled.fiber_force(x, speed) - pulled.tendon_force(x); });
    const Real shared = fiber_share(pulled, fiber, speed) * path_speed * fibers.cosine(fiber) / largest;
    const Real change = shared - speed;
    speed += (i < 5 ? 1 : 0.5) * change;
    if (std::abs(change) < 1e-10) break;
  }
  return {muscle.max_isometric_force * pulled.tendon_force(fiber), fiber, speed * largest};
}

MuscleState muscle_state(const Muscle& muscle, Real activation, Real length, Real speed, bool elastic) {
  const PulledMuscle pulled{muscle, activation, length, FiberGeometry(muscle)};
  if (!elastic || muscle.ignore_tendon_compliance || !(muscle.tendon_slack_length > 0))
    return rigid_state(pulled, speed);
  return elastic_state(pulled, speed);
}

}  // namespace gracilis::opensim
