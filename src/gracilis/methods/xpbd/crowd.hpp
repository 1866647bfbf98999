#pragma once

#include <gracilis/dynamics/surface_contact.hpp>
#include <gracilis/dynamics/virtual_edges.hpp>
#include <gracilis/methods/xpbd/preparation.hpp>
#include <gracilis/scene/settings.hpp>

#include <vector>

namespace gracilis::xpbd {

/// How the muscles of a scene keep out of each other. What the settings do not choose has no pairs.
struct MuscleCrowd {
  SurfaceCrowd surfaces;
  VirtualEdgeCrowd edges;
  bool meets() const { return !surfaces.pairs.empty() || !edges.pairs.empty(); }
};

/// What of it changes.
struct MuscleCrowdState {
  CrowdState surfaces;     ///< workspace of a step
  VirtualEdgeState edges;  ///< goes on from frame to frame
};

/// Which muscles may meet and, in surface contact, with what gaps, measured at rest. No pairs when contact is switched
/// off.
MuscleCrowd prepare_crowd(const ContactSettings& settings, const std::vector<PreparedMuscle>& muscles);

/// A state for muscles at rest.
MuscleCrowdState make_crowd_state(const MuscleCrowd& crowd);

}  // namespace gracilis::xpbd
