#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

#include <vector>

namespace gracilis {

/// Per vertex of a closed surface the one that it faces through the body inside: of the triangle that the line inwards
/// along its normal meets first, the nearest corner; -1 where that line meets none (as outside a surface with holes).
/// Lines begin a millionth of the surface's size inside. Precondition: at least one face, all coordinates finite.
std::vector<Index> opposite_vertices(const TriangleMesh& surface);

}  // namespace gracilis
