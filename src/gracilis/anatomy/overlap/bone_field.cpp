#include <gracilis/anatomy/overlap/bone_field.hpp>

namespace gracilis {

DistanceField build_bone_field(const Bone& bone, const DistanceFieldSettings& settings) {
  return build_distance_field(bone.surface,
                              settings.resolution > 0
                                  ? domain_by_resolution(bone.surface, settings.resolution, settings.domain_factor)
                                  : domain_by_cell_size(bone.surface, settings.cell_size, settings.domain_margin));
}

}  // namespace gracilis
