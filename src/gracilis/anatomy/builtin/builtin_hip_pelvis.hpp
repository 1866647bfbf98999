#pragma once

#include <gracilis/anatomy/builtin/builtin_hip_bones.hpp>
#include <gracilis/geometry/implicit_surface.hpp>

namespace gracilis::builtin_hip_shapes {

ImplicitSolid right_hip_bone();

}  // namespace gracilis::builtin_hip_shapes
