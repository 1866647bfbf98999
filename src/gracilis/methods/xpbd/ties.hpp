#pragma once

#include <gracilis/anatomy/attachments/muscle_bodies.hpp>
#include <gracilis/dynamics/contact/surface/surface_ties.hpp>
#include <gracilis/methods/xpbd/preparation.hpp>
#include <gracilis/scene/scene.hpp>

#include <vector>

namespace gracilis::xpbd {

/// Muscles whose ends lie on others. While strings carry a muscle, they carry what lies on it, too: where a predicted
/// frame begins depends on the poses alone. Then the solver holds each end where it lay.
struct MuscleTies {
  std::vector<TiedSurfaces> surfaces;            ///< hosts before their guests
  std::vector<CarriedBody> bodies;               ///< in the same order; patches of particles
  std::vector<std::vector<std::size_t>> groups;  ///< of muscles, hosts first; empty: nothing lies on a muscle
  bool any() const { return !bodies.empty(); }   ///< something lies on a muscle
};

/// `muscles` are those of the scene, in its order.
MuscleTies prepare_ties(const Scene& scene, const std::vector<PreparedMuscle>& muscles);

}  // namespace gracilis::xpbd
