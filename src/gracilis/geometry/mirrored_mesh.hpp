#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

namespace gracilis {

/// Mirrors points in the plane through the origin at right angles to the unit vector `across`.
Points mirrored(const Points& points, const Vec3& across);

/// The same of a surface, which faces outwards as before; vertices and faces keep their order.
TriangleMesh mirrored(const TriangleMesh& mesh, const Vec3& across);

}  // namespace gracilis
