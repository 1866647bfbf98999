#pragma once

#include <gracilis/geometry/distance_field.hpp>
#include <gracilis/scene/scene.hpp>

namespace gracilis {

/// The distance field of one bone by the scene's settings.
DistanceField build_bone_field(const Bone& bone, const DistanceFieldSettings& settings);

}  // namespace gracilis
