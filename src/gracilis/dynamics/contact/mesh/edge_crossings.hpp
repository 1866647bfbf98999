#pragma once

#include <gracilis/dynamics/contact/mesh/contact_surface.hpp>

namespace gracilis {

/// The places of an edge's ends, m.
struct Segment {
  Eigen::Vector3f from, to;

  float length2() const { return (to - from).squaredNorm(); }  ///< m², of its square
};

/// Leaves of `candidates`, edges of the surface, those that come nearer than `within` (m) to the edge where both lie
/// across each other between their ends; rounding never takes one away. Parallel edges do not cross.
void keep_crossing(const Segment& edge, float within, const ContactSurface& surface, const Particles& particles,
                   std::vector<Index>& candidates);

}  // namespace gracilis
