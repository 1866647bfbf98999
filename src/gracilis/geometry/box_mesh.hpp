#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

#include <array>

namespace gracilis {

/// The surface of the box from `low` to `high`, each side cut into a grid of rectangles (`cells` along x, y, z) and
/// each rectangle into two triangles by alternating diagonals: closed, outward, 4 (xy + yz + zx) faces. Preconditions:
/// low < high in each component, cells at least 1.
TriangleMesh box_mesh(const Vec3& low, const Vec3& high, const std::array<int, 3>& cells);

}  // namespace gracilis
