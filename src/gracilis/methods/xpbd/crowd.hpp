#pragma once

#include <gracilis/dynamics/contact/surface/surface_crowd.hpp>
#include <gracilis/dynamics/havlicek_2024/virtual_edges.hpp>
#include <gracilis/methods/xpbd/preparation.hpp>
#include <gracilis/methods/xpbd/ties.hpp>
#include <gracilis/scene/scene.hpp>

#include <vector>

namespace gracilis::xpbd {

/// How the muscles of a scene keep out of each other, and which lie on others. What the settings do not choose has no
/// pairs.
struct MuscleCrowd {
  SurfaceCrowd surfaces;
  VirtualEdgeCrowd edges;
  MuscleTies ties;
  bool meets() const { return !surfaces.pairs.empty() || !edges.pairs.empty() || ties.any(); }
};

/// What of it changes. Both go on for `update_period` frames, and then begin again with nothing but where the muscles
/// are.
struct MuscleCrowdState {
  CrowdState surfaces;
  VirtualEdgeState edges;
};

/// Which muscles may meet and, in surface contact, with what gaps, measured at rest. No pairs when contact is switched
/// off, or where they do not `meet`.
MuscleCrowd prepare_crowd(const Scene& scene, const std::vector<PreparedMuscle>& muscles, bool meet = true);

/// A state for muscles at rest.
MuscleCrowdState make_crowd_state(const MuscleCrowd& crowd);

/// As if no frame had begun yet.
void forget_contact(const MuscleCrowd& crowd, MuscleCrowdState& state);

}  // namespace gracilis::xpbd
