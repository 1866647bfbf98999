#pragma once

#include <gracilis/methods/tissue/total_energy.hpp>

namespace gracilis::tissue {

/// A muscle's surface as it is seen: its vertices lie in the tissue, but where its triangles are larger than cells the
/// flat ones hold more or less than what the tissue between their corners does, and lie in bones that the tissue winds
/// around. Vertices give way by as much as is missing at them. Follows from the nodes and bodies alone, without jumps;
/// forces and lengths inside are those of the tissue. 3 × vertices, m.
/// `distances`: to the bones.
Points seen_surface(const PreparedTissue& muscle, const Surroundings& around,
                    const std::vector<SignedDistance>& distances, const Points& nodes);

/// The same without a look at bones. `tissue_surface`: surface_at these nodes.
Points enclosing_surface(const PreparedTissue& muscle, const Points& nodes, const Points& tissue_surface);

/// Moves the free part of the surface (x: 3 × vertices, m) out evenly, so that it encloses so much, m³.
void meet_volume(const PreparedTissue& muscle, Real asked, Points& x);

/// What the surface lacks of the tissue beneath each large triangle, m³; of `corners`, which are where its vertices
/// are. Less than zero where it holds more.
std::vector<Real> lacking_volumes(const PreparedTissue& muscle, const Points& nodes, const Points& corners);

}  // namespace gracilis::tissue
