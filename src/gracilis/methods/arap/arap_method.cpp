#include <gracilis/methods/arap/arap_method.hpp>

#include <gracilis/anatomy/attachments/body_carriers.hpp>
#include <gracilis/anatomy/overlap/bone_projection.hpp>
#include <gracilis/core/stop.hpp>
#include <gracilis/geometry/arap_surface.hpp>
#include <gracilis/geometry/arap_volume.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/methods/placed_method.hpp>
#include <gracilis/methods/shape_method.hpp>
#include <gracilis/methods/shared_rows.hpp>

namespace gracilis {

template <>
std::span<const Setting<ArapSettings>> setting_table() {
  using S = ArapSettings;
  static const Setting<S> table[] = {
      {"iterations", &S::iterations, "", 1, 100000,
       "How often per frame rotations and places are chosen in turn, each time followed by volume and contact."},
      {"volume", &S::volume, "", 0, 0,
       "How the volume is restored: 'scaling' of the free vertices about the muscle's center by (V0/V)^(1/3), "
       "'multiplier' of an even pressure that the surface passes on, or 'none'."},
      {"tendon_length", &S::tendon_length, "m", 0, 1,
       "Distance from the attachments over which the blend of the bodies' motions, where a frame begins, is graded "
       "from tendon to belly; 0 grades nothing."},
      bone_margin_row<S>(),
      bone_rest_gap_row<S>(),
  };
  return table;
}

namespace {

/// Rounds of volume and contact alone that end a frame.
constexpr int settling_rounds = 4;

/// What stays the same of one muscle.
struct ArapMuscle {
  ArapSettings settings;
  TriangleMesh rest;  ///< world, in the capture pose, m
  Real volume = 0;    ///< m³, of the rest
  BodyCarriers carriers;
  std::vector<char> held;  ///< per vertex: attached, or out of every attachment's reach
  arap::Surface surface;
  BoneProjection bones;
};

ArapMuscle prepare_arap(const Scene& scene, const Muscle& muscle, const std::vector<DistanceField>& fields) {
  const ArapSettings settings = muscle_settings<ArapSettings>(scene, muscle);
  const MeshTopology topology = build_topology(muscle.surface.faces, muscle.surface.vertex_count());
  BodyCarriers carriers = body_carriers(muscle, topology, settings.tendon_length);
  std::vector<char> held = held_vertices(carriers);
  arap::Surface surface(muscle.surface, topology, held);
  BoneProjection bones(scene, muscle, carriers.fixed_body, fields, settings.bone_margin, settings.bone_rest_gap);
  return {settings,
          muscle.surface,
          enclosed_volume(muscle.surface.vertices, muscle.surface.faces),
          std::move(carriers),
          std::move(held),
          std::move(surface),
          std::move(bones)};
}

void restore_volume(const ArapMuscle& muscle, Points& points) {
  if (muscle.settings.volume == ArapVolume::scaling)
    arap::restore_volume_by_scaling(muscle.rest.faces, muscle.held, muscle.volume, points);
  if (muscle.settings.volume == ArapVolume::multiplier)
    arap::restore_volume_by_multiplier(muscle.surface, muscle.rest.faces, muscle.held, muscle.volume, points);
}

ShapeStep step(const ArapMuscle& muscle, const Pose& last, const Pose& now, const Points& before) {
  Points points = carried_on(muscle.carriers, muscle.rest.vertices, last, now, before);
  Index contacts = 0;
  const auto restore_and_push = [&] {
    restore_volume(muscle, points);
    contacts = muscle.bones.push_out(now, points);
  };
  for (int i = 0; i < muscle.settings.iterations; ++i) {
    throw_if_stopped();
    muscle.surface.place(muscle.surface.best_rotations(points), points);
    restore_and_push();
  }
  for (int i = 0; i < settling_rounds && contacts > 0; ++i) restore_and_push();
  return {std::move(points), {{"contacts", static_cast<Real>(contacts)}}};
}

ShapedMuscle shaped_by_arap(const Scene& scene, const Muscle& muscle, const std::vector<DistanceField>& fields) {
  const auto prepared = std::make_shared<const ArapMuscle>(prepare_arap(scene, muscle, fields));
  return {muscle.name, muscle.surface.vertices, [prepared](const Pose& last, const Pose& now, const Points& before) {
            return step(*prepared, last, now, before);
          }};
}

}  // namespace

std::unique_ptr<DeformationMethod> make_arap_method(const Scene& scene, std::vector<DistanceField> fields) {
  return made_near_origin(scene, std::move(fields), [](const Scene& near, std::vector<DistanceField> near_fields) {
    return shape_method(near, std::move(near_fields), shaped_by_arap);
  });
}

MethodEntry arap_entry() {
  return {.name = "arap",
          .meaning = "their surfaces, kept as rigid as possible between attachments",
          .settings = describe_settings<ArapSettings>(),
          .metrics = {{"contacts", 0}},
          .make = [](const Scene& scene, const BoneFieldSource& fields) {
            return make_arap_method(scene, fields(scene.distance_fields));
          }};
}

}  // namespace gracilis
