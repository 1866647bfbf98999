#include <gracilis/simulate/bone_space.hpp>

namespace gracilis {

static constexpr Real cell_size = 0.003;  ///< m
static constexpr Real margin = 0.015;     ///< m

BoneSpace::BoneSpace(const Scene& scene, const std::vector<SignedDistance>& exact) {
  for (std::size_t b = 0; b < scene.bones.size(); ++b) {
    fields_.emplace_back(scene.bones[b].surface, exact[b], cell_size, margin);
    bodies_.push_back(static_cast<std::size_t>(scene.bones[b].body));
  }
}

}  // namespace gracilis
