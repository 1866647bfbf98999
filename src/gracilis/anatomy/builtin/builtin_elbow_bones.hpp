#pragma once

#include <gracilis/anatomy/builtin/builtin_shapes.hpp>
#include <gracilis/core/types.hpp>

namespace gracilis {

/// The shapes of the built-in elbow's bones. All live in the same frame: metres, origin on the flexion axis between
/// trochlea and capitulum, which is the z axis; x anterior, y superior, z to the subject's right; the arm hanging,
/// elbow straight, palm forward. Where the sizes come from is told in docs/bibliography.md, 'Built-in elbow'.
namespace builtin_elbow_shapes {

using namespace builtin_shapes;

inline const Vec3 humeral_head = millimetres(-13, 285, -24);  ///< center
inline constexpr Real humeral_head_radius = 0.023;
inline const Vec3 radial_head = millimetres(0, -14, 14);  ///< the forearm turns about the line from here to the wrist
inline constexpr Real joint_gap = 0.0013;                 ///< between bones that glide on each other

}  // namespace builtin_elbow_shapes
}  // namespace gracilis
