#pragma once

#include <gracilis/geometry/distance_field.hpp>

namespace gracilis::tissue {

/// A field's answer in double precision: what single precision would round off a place, stiff contact would make forces
/// of, larger than the residual that is asked for.
struct BoneDistance {
  Real distance = 0;             ///< m; infinity outside of the grid
  Vec3 gradient = Vec3::Zero();  ///< of the trilinear interpolant
};
BoneDistance bone_distance(const DistanceField& field, const Vec3& p);

}  // namespace gracilis::tissue
