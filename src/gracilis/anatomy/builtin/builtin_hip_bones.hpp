#pragma once

#include <gracilis/anatomy/builtin/builtin_shapes.hpp>
#include <gracilis/core/types.hpp>

namespace gracilis {

/// The shapes of the built-in hip's bones. All live in the same frame: metres, origin at the center of the right hip
/// joint, x anterior, y superior, z to the subject's right, the subject standing. Where the landmarks come from is told
/// in docs/bibliography.md, 'Built-in hip'.
namespace builtin_hip_shapes {

using namespace builtin_shapes;

/// The median plane is z = median_plane.
inline constexpr Real median_plane = -0.084;
inline constexpr Real head_radius = 0.0245;    ///< of the femoral head
inline constexpr Real socket_radius = 0.0262;  ///< of the acetabulum: leaves a joint gap of 1.7 mm

}  // namespace builtin_hip_shapes
}  // namespace gracilis
