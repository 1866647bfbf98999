#pragma once

#include <gracilis/dynamics/contact/surface/contact_world.hpp>
#include <gracilis/dynamics/havlicek_2024/virtual_edges.hpp>
#include <gracilis/methods/xpbd/preparation.hpp>
#include <gracilis/methods/xpbd/ties.hpp>
#include <gracilis/scene/scene.hpp>

#include <vector>

namespace gracilis::xpbd {

/// How the muscles of a scene keep out of each other, and which lie on others. What the settings do not choose has no
/// pairs.
struct MuscleContactWorld {
  ContactWorld surfaces;
  VirtualEdgeWorld edges;
  MuscleTies ties;
  /// Anything meets, or lies on, anything.
  bool meets() const { return !surfaces.pairs.empty() || !edges.pairs.empty() || ties.any(); }
};

/// What of it changes. Both go on for `update_period` frames, and then begin again with nothing but where the muscles
/// are.
struct MuscleContactState {
  ContactWorldState surfaces;
  VirtualEdgeState edges;
};

/// Which muscles may meet and, in surface contact, with what gaps, measured at rest. No pairs when contact is switched
/// off, or where they do not `meet`.
MuscleContactWorld prepare_contact_world(const Scene& scene, const std::vector<PreparedMuscle>& muscles,
                                         bool meet = true);

/// A state for muscles at rest.
MuscleContactState make_contact_state(const MuscleContactWorld& world);

/// As if no frame had begun yet.
void forget_contact(const MuscleContactWorld& world, MuscleContactState& state);

}  // namespace gracilis::xpbd
