#pragma once

#include <gracilis/dynamics/contact/self/self_contact.hpp>
#include <gracilis/dynamics/contact/surface/contact_world.hpp>

#include <vector>

namespace gracilis {

/// Pairs of edges, one of each surface, that cross closely, by what the particles of the first are near
/// (`near_second`). Within one surface `self` tells which parts may meet; null for two. What crossed wrongly `before`
/// the step is taken apart gradually, as overlaps are (overlap_release.hpp).
void find_edges(const ContactWorld& world, const SurfacePair& pair, const std::vector<const Particles*>& particles,
                const std::vector<Particles>& before, const std::vector<VertexFaceCandidate>& near_second,
                const SelfRule* self, std::vector<EdgeEdgeCandidate>& found);

}  // namespace gracilis
