#include <gracilis/strings/bone_distances.hpp>

#include <algorithm>
#include <limits>

namespace gracilis::strings {

DistanceFieldSettings far_field_settings() {
  DistanceFieldSettings settings;
  settings.cell_size = 0.0025;
  settings.domain_margin = 0.045;
  return settings;
}

BoneDistances bone_distances(const Scene& scene, const std::vector<DistanceField>& far_fields) {
  BoneDistances bones;
  for (std::size_t b = 0; b < far_fields.size(); ++b) {
    bones.fields.push_back(bounded(far_fields[b]));
    bones.bodies.push_back(scene.bones[b].body);
  }
  return bones;
}

Real distance_to_body(const BoneDistances& bones, Index body, const Vec3& place) {
  Real least = std::numeric_limits<Real>::infinity();
  for (std::size_t b = 0; b < bones.fields.size(); ++b)
    if (bones.bodies[b] == body)
      least = std::min(least, static_cast<Real>(sample_bounded(bones.fields[b], place.cast<float>()).distance));
  return least;
}

}  // namespace gracilis::strings
