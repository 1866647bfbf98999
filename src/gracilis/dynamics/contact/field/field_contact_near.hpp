#pragma once

#include <gracilis/dynamics/constraints/distance.hpp>
#include <gracilis/dynamics/contact/field/face_set.hpp>
#include <gracilis/dynamics/contact/field/near_field.hpp>
#include <gracilis/dynamics/particles.hpp>

namespace gracilis {

/// Brings back particles that passed through the obstacle since they were last seen (the set's guard), then lists what
/// is within `reach` (m) of touching: movable particles, edges and faces with a movable corner.
void find_near(const FieldContactSet& set, const DistanceSet& distances, const FaceSet& faces,
               const FieldPlacement& placement, float reach, Particles& particles, NearField& near);

/// Finds the deepest points of the edges that are near anew: others may have become deeper than those that are
/// followed.
void find_edge_points(const FieldContactSet& set, const FieldPlacement& placement, const Particles& particles,
                      NearField& near);

}  // namespace gracilis
