#pragma once

#include <gracilis/geometry/field_path.hpp>
#include <gracilis/scene/scene.hpp>

#include <vector>

namespace gracilis::strings {

/// Coarse distance fields that reach far from the bones, one per bone of a scene, and the bodies that these belong to.
struct BoneDistances {
  std::vector<BoundedField> fields;  ///< the grids must outlive this
  std::vector<Index> bodies;         ///< of each bone
  /// Per body without bones: the vertices of all muscles that are attached to it, which is all that tells where it is.
  std::vector<Points> attached;
};

/// How fine and far such fields are: 2.5 mm cells, 45 mm around a bone.
DistanceFieldSettings far_field_settings();

/// Precondition: one field per bone of the scene, or none, where no muscle is carried by strings.
BoneDistances bone_distances(const Scene& scene, const std::vector<DistanceField>& far_fields);

/// The distance (m) of a place in the capture pose to the nearest bone of a body; beyond the fields a lower bound. Of a
/// body without bones, the distance to what is attached to it; infinite where there is nothing either.
Real distance_to_body(const BoneDistances& bones, Index body, const Vec3& place);

}  // namespace gracilis::strings
