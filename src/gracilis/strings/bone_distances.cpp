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

static Points attached_to(const Scene& scene, Index body) {
  std::vector<Vec3> places;
  for (const Muscle& muscle : scene.muscles)
    for (const Attachment& attachment : muscle.attachments)
      for (const Index v : attachment.vertices)
        if (attachment.body == body) places.emplace_back(muscle.surface.vertices.col(v));
  Points points(3, static_cast<Index>(places.size()));
  for (std::size_t i = 0; i < places.size(); ++i) points.col(static_cast<Index>(i)) = places[i];
  return points;
}

BoneDistances bone_distances(const Scene& scene, const std::vector<DistanceField>& far_fields) {
  BoneDistances bones;
  for (std::size_t b = 0; b < far_fields.size(); ++b) {
    bones.fields.push_back(bounded(far_fields[b]));
    bones.bodies.push_back(scene.bones[b].body);
  }
  for (Index body = 0; body < static_cast<Index>(scene.bodies.size()); ++body) {
    const bool has_bones =
        std::any_of(scene.bones.begin(), scene.bones.end(), [&](const Bone& b) { return b.body == body; });
    bones.attached.push_back(has_bones ? Points(3, 0) : attached_to(scene, body));
  }
  return bones;
}

Real distance_to_body(const BoneDistances& bones, Index body, const Vec3& place) {
  Real least = std::numeric_limits<Real>::infinity();
  for (std::size_t b = 0; b < bones.fields.size(); ++b)
    if (bones.bodies[b] == body)
      least = std::min(least, static_cast<Real>(sample_bounded(bones.fields[b], place.cast<float>()).distance));
  if (const Points& attached = bones.attached[static_cast<std::size_t>(body)]; attached.cols() > 0)
    least = (attached.colwise() - place).colwise().norm().minCoeff();
  return least;
}

}  // namespace gracilis::strings
