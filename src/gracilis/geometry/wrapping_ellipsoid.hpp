#pragma once

#include <gracilis/geometry/wrapping.hpp>

namespace gracilis {

/// Around an ellipsoid, in a plane through both points and a third on the surface, which OpenSim chooses so that it
/// hardly jumps: near where the surface is nearest to the line. The way is somewhat longer than the shortest.
Wrap wrap_ellipsoid(const WrapSurface& surface, const Vec3& a, const Vec3& b, WrapSurface::Plane plane);

/// The point of an ellipsoid about the origin with these half axes that is nearest to `point`; one less than 1e-4 away
/// from a plane of symmetry keeps to that plane, of several to the one that cuts the smallest ellipse (Eberly 1994, as
/// OpenSim has it).
Vec3 nearest_on_ellipsoid(const Vec3& radii, const Vec3& point);

}  // namespace gracilis
