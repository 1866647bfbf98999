#pragma once

#include <gracilis/anatomy/builtin/builtin_elbow_bones.hpp>
#include <gracilis/geometry/implicit_surface.hpp>

namespace gracilis::builtin_elbow_shapes {

/// What the ulna glides on: the spool of the humerus, turned about the flexion axis, `margin` larger all around.
ImplicitSolid trochlea(Real margin);
/// What the radius glides on, `margin` larger all around.
ImplicitSolid capitulum(Real margin);
ImplicitSolid right_humerus();

}  // namespace gracilis::builtin_elbow_shapes
