#pragma once

#include <gracilis/dynamics/solver/surface_solve.hpp>
#include <gracilis/methods/xpbd/contact_world.hpp>
#include <gracilis/methods/xpbd/step.hpp>

#include <vector>

namespace gracilis::xpbd {

/// The particles of all steps, as pointers to what may or may not be changed.
template <class Pointer>
std::vector<Pointer> particles_of(const std::vector<MuscleStep>& steps) {
  std::vector<Pointer> particles;
  for (const MuscleStep& step : steps) particles.push_back(&step.state->particles);
  return particles;
}

/// What acts between muscles, from where they are: the prediction. The contact world, its state, the steps' states and
/// `predicted`, a copy of their particles, must outlive it.
Coupling couple(const std::vector<MuscleStep>& steps, const std::vector<Particles>& predicted,
                const MuscleContactWorld& world, MuscleContactState& state);

}  // namespace gracilis::xpbd
