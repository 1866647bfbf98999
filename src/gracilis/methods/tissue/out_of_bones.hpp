#pragma once

#include <gracilis/methods/tissue/total_energy.hpp>

namespace gracilis::tissue {

/// How often what is pushed out of a bone is looked at again: the field's gradient is not straight out.
inline constexpr int bone_rounds = 4;

/// What the bone's field says at a place in the bone's frame, m.
inline Real distance_in(const BoneGap& bone, const Vec3& there) {
  return static_cast<Real>(sample_bounded(bone.field, there.cast<float>()).distance);
}

/// The field's distance at a place is no less, since the bone was looked at from vertex `v` close by.
inline Real least_distance(const CachedBoneQuery& query, Index v, const Vec3& there) {
  return query.distances[v] - largest_slope * (there - query.places.col(v)).norm();
}

/// Pushes vertices and the middles of edges out of bones, as far as what is seen of a muscle has to keep off them: soft
/// contact lets them come too near. `x`: the surface's vertices, 3 × n, m; `distances`: to the bones.
void push_out_of_bones(const PreparedTissue& muscle, const Surroundings& around,
                       const std::vector<SignedDistance>& distances, Points& x);

}  // namespace gracilis::tissue
