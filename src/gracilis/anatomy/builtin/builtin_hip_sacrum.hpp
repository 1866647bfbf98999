#pragma once

#include <gracilis/anatomy/builtin/builtin_hip_bones.hpp>
#include <gracilis/geometry/implicit_surface.hpp>

namespace gracilis::builtin_hip_shapes {

/// The sacrum with the coccyx, kept clear of the right hip bone and its mirror image.
ImplicitSolid sacrum(const ImplicitSolid& right_hip_bone);

}  // namespace gracilis::builtin_hip_shapes
