#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/implicit_surface.hpp>

/// What the shapes of all built-in scenes are written with.
namespace gracilis::builtin_shapes {

/// A point in millimetres with a radius in millimetres: anatomy is read and written in these.
inline ThickPoint thick(Real x, Real y, Real z, Real radius) { return {1e-3 * Vec3(x, y, z), 1e-3 * radius}; }
/// The same without a radius; the result is in m.
inline Vec3 millimetres(Real x, Real y, Real z) { return 1e-3 * Vec3(x, y, z); }

}  // namespace gracilis::builtin_shapes
