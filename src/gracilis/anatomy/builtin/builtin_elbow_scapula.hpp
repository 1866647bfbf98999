#pragma once

#include <gracilis/anatomy/builtin/builtin_elbow_bones.hpp>
#include <gracilis/geometry/implicit_surface.hpp>

namespace gracilis::builtin_elbow_shapes {

ImplicitSolid right_scapula();

}  // namespace gracilis::builtin_elbow_shapes
