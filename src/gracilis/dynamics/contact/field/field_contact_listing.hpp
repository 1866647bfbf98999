#pragma once

#include <gracilis/dynamics/constraints/distance.hpp>
#include <gracilis/dynamics/contact/field/face_set.hpp>
#include <gracilis/dynamics/contact/field/near_field.hpp>
#include <gracilis/dynamics/particles.hpp>

#include <vector>

namespace gracilis {

/// Edges and faces count as near when they may come this deep below their gap before the next listing, m; no particle
/// may go farther than `listed_motion` until then.
inline constexpr float element_reach = 0.002f;
inline constexpr float listed_motion = element_reach / steepest;

/// What a particle or an element keeps while the obstacle passes from where it was captured to where it is released
/// (FieldPlacement::release).
inline float blended(const std::vector<float>& captured, const std::vector<float>& released, std::size_t i,
                     float release) {
  return captured[i] + release * (released[i] - captured[i]);
}

/// Within what distance from its gap, m, a particle may be listed, or an edge or a face at it; faces are not much
/// larger than edges.
float listing_reach(const DistanceSet& distances, float reach);

/// Empties the lists of what is near.
void clear_near(NearField& near);

/// Lists the edges, and the faces, that may come near before the next listing, by the clearances of their particles.
void list_edges(const FieldContactSet& set, const DistanceSet& distances, const FieldPlacement& placement,
                const Particles& particles, NearField& near);
/// As list_edges, of the faces.
void list_faces(const FieldContactSet& set, const FaceSet& faces, const FieldPlacement& placement,
                const Particles& particles, NearField& near);

}  // namespace gracilis
