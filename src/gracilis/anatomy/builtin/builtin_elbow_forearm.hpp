#pragma once

#include <gracilis/anatomy/builtin/builtin_elbow_bones.hpp>
#include <gracilis/geometry/implicit_surface.hpp>

namespace gracilis::builtin_elbow_shapes {

/// The disc that turns in the notch of the ulna, `margin` larger all around, without the dish for the capitulum.
ImplicitSolid radial_disc(Real margin);
/// The end of the ulna that the radius turns about, `margin` larger all around.
ImplicitSolid ulnar_head(Real margin);

ImplicitSolid right_ulna();
ImplicitSolid right_radius();

}  // namespace gracilis::builtin_elbow_shapes
