#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

#include <vector>

namespace gracilis {

/// Which faces of a surface lie inside a closed outline beside it: the outline's points go to their nearest vertices,
/// the shortest ways along edges between these cut the surface, and of what they part the largest piece is outside.
/// 1 per face inside; none where the outline encloses no face. The surface may have holes.
std::vector<char> faces_inside(const TriangleMesh& surface, const Points& outline);

/// Area of the marked faces, m².
Real marked_area(const TriangleMesh& surface, const std::vector<char>& marked);

}  // namespace gracilis
