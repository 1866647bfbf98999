#pragma once

#include <gracilis/geometry/surface_extraction.hpp>

namespace gracilis {

/// Makes all edges about `edge_length` long and triangles near equilateral by splitting, collapsing and flipping edges
/// and by moving vertices within the surface of `solid` (Botsch and Kobbelt 2004). The mesh stays closed, manifold,
/// oriented, and of its genus. Precondition: `mesh` is closed, manifold and lies near the surface of `solid`.
TriangleMesh remesh(const TriangleMesh& mesh, const SampledSolid& solid, Real edge_length);

}  // namespace gracilis
