#include <gracilis/simulate/scene_method.hpp>

#include <gracilis/methods/cylinder/cylinder_method.hpp>
#include <gracilis/methods/xpbd/xpbd_method.hpp>

namespace gracilis {

std::unique_ptr<DeformationMethod> make_scene_method(const Scene& scene,
                                                     const std::function<std::vector<DistanceField>()>& fields) {
  return scene.method == MethodKind::cylinder ? make_cylinder_method(scene) : make_xpbd_method(scene, fields());
}

}  // namespace gracilis
