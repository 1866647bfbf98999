#include <gracilis/opensim/static_optimization/rigid_tendon.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis::opensim {

/// The factor by which OpenSim has the fibers' force become the tendon's.
static Real opensim_cosine(const Muscle& muscle, const FiberGeometry& fibers, Real length) {
  switch (curves_of(muscle)) {
    case MuscleCurves::millard: {
      const Real sine = fibers.height / (length / muscle.optimal_fiber_length);
      return std::cos(std::min(std::asin(std::min(sine, 1.0)), muscle.max_pennation_angle));
    }
    case MuscleCurves::de_groote:
      if (muscle.type == "DeGrooteFregly2016Muscle") return 1;
      break;
    case MuscleCurves::thelen:
      break;
  }
  return fibers.cosine(length);
}

Real rigid_tendon_force(const Muscle& muscle, Real length, Real speed) {
  const Real optimal = muscle.optimal_fiber_length, along = length - muscle.tendon_slack_length;
  const FiberGeometry fibers(muscle);
  const Real fiber = std::hypot(along, fibers.height);
  if (along <= 0 || fiber <= fibers.shortest) return 0;
  const Real fiber_speed = speed * (along / fiber) / (optimal * muscle.max_contraction_velocity);
  return muscle.max_isometric_force * force_length_factor(muscle, fiber / optimal) *
         force_velocity_factor(muscle, fiber_speed) * opensim_cosine(muscle, fibers, fiber);
}

}  // namespace gracilis::opensim
