#pragma once

#include <gracilis/geometry/distance_field.hpp>
#include <gracilis/io/scene/field_cache.hpp>

#include <algorithm>
#include <limits>
#include <vector>

namespace gracilis {

/// Bones in one pose, each where its body has carried it.
struct PlacedBones {
  std::vector<DistanceField> fields;
  std::vector<RigidTransform> bodies;

  FieldSample at(std::size_t bone, const Vec3& x) const {
    return sample(fields[bone], (bodies[bone].inverse() * x).cast<float>());
  }

  /// To the nearest, m; infinite beyond the fields.
  Real distance(const Vec3& x) const {
    float nearest = std::numeric_limits<float>::infinity();
    for (std::size_t b = 0; b < fields.size(); ++b) nearest = std::min(nearest, at(b, x).distance);
    return nearest;
  }

  /// Where a point has to be to lie in none of them.
  Vec3 outside(Vec3 x) const {
    for (std::size_t b = 0; b < fields.size(); ++b) {
      const FieldSample seen = at(b, x);
      const Vec3 out = bodies[b].linear() * seen.gradient.cast<Real>();
      if (seen.distance < 0 && out.squaredNorm() > 1e-4) x -= seen.distance / out.squaredNorm() * out;
    }
    return x;
  }
};

inline PlacedBones placed_bones(const Scene& scene, const Pose& pose) {
  PlacedBones bones{cached_bone_fields(scene), {}};
  for (const Bone& bone : scene.bones) bones.bodies.push_back(pose.bodies[static_cast<std::size_t>(bone.body)]);
  return bones;
}

}  // namespace gracilis
