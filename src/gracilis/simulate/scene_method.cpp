#include <gracilis/simulate/scene_method.hpp>

#include <gracilis/methods/cylinder/cylinder_method.hpp>
#include <gracilis/methods/xpbd/xpbd_method.hpp>
#include <gracilis/strings/bone_distances.hpp>

namespace gracilis {

std::unique_ptr<DeformationMethod> make_scene_method(const Scene& scene, const BoneFieldSource& fields) {
  if (scene.method == MethodKind::cylinder) return make_cylinder_method(scene);
  std::vector<DistanceField> far_fields;
  if (needs_far_fields(scene)) far_fields = fields(strings::far_field_settings());
  return make_xpbd_method(scene, fields(scene.distance_fields), std::move(far_fields));
}

}  // namespace gracilis
