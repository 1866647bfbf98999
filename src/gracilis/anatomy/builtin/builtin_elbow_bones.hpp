#pragma once

#include <gracilis/anatomy/builtin/builtin_shapes.hpp>
#include <gracilis/core/types.hpp>
#include <gracilis/geometry/implicit_surface.hpp>

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

/// What the ulna glides on: the spool of the humerus, turned about the flexion axis, `margin` larger all around.
ImplicitSolid trochlea(Real margin);
/// What the radius glides on, `margin` larger all around.
ImplicitSolid capitulum(Real margin);
/// The disc that turns in the notch of the ulna, `margin` larger all around, without the dish for the capitulum.
ImplicitSolid radial_disc(Real margin);
/// The end of the ulna that the radius turns about, `margin` larger all around.
ImplicitSolid ulnar_head(Real margin);

ImplicitSolid right_scapula();
ImplicitSolid right_humerus();
ImplicitSolid right_ulna();
ImplicitSolid right_radius();

}  // namespace builtin_elbow_shapes
}  // namespace gracilis
