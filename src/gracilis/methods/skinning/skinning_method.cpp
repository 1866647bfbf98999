#include <gracilis/methods/skinning/skinning_method.hpp>

#include <gracilis/anatomy/attachments/body_carriers.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/methods/shape_method.hpp>

namespace gracilis {

struct SkinningSettings {
  Real tendon_length = 0.03;  ///< m from attachments, graded from tendon to belly; 0: no tendons
};

template <>
std::span<const Setting<SkinningSettings>> setting_table() {
  using S = SkinningSettings;
  static const Setting<S> table[] = {
      {"tendon_length", &S::tendon_length, "m", 0, 1,
       "Distance from the attachments over which the surface is graded from tendon to belly, so that the bones' motion "
       "stretches the belly and not the triangles beside an attachment; 0 grades nothing."},
  };
  return table;
}

namespace {

ShapedMuscle shaped_by_skinning(const Scene& scene, const Muscle& muscle, const std::vector<DistanceField>&) {
  const MeshTopology topology = build_topology(muscle.surface.faces, muscle.surface.vertex_count());
  const Real tendon_length = muscle_settings<SkinningSettings>(scene, muscle).tendon_length;
  const Points& rest = muscle.surface.vertices;
  return {muscle.name, rest,
          [rest, carriers = body_carriers(muscle, topology, tendon_length)](const Pose&, const Pose& now, const Points&)
              -> ShapeStep { return {moved_by(carried_motions(carriers, now), rest)}; }};
}

}  // namespace

std::unique_ptr<DeformationMethod> make_skinning_method(const Scene& scene) {
  return shape_method(scene, {}, shaped_by_skinning);
}

MethodEntry skinning_entry() {
  return {.name = "skinning",
          .meaning = "a blend of the motions of the bodies that they are attached to, to compare with",
          .settings = describe_settings<SkinningSettings>(),
          .make = [](const Scene& scene, const BoneFieldSource&) { return make_skinning_method(scene); }};
}

}  // namespace gracilis
