#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

#include <array>
#include <vector>

namespace gracilis {

/// The edge that a surface's triangles would have if all were equilateral and of one size, m; 0 of a surface without
/// area.
Real even_edge(const TriangleMesh& mesh);

/// Whether a surface is made of needles, as those are whose triangles were thinned out by a program that minds nothing
/// but the shape: more than 1 % of the edges are longer than three even edges.
bool has_needles(const TriangleMesh& mesh);

/// A surface whose needles were divided.
struct DividedNeedles {
  TriangleMesh mesh;  ///< the old vertices first, in their order
  std::vector<std::array<Index, 2>>
      ends;  ///< of each new vertex: the ends of the edge that it halved; either may be new
};

/// Gives a closed surface better triangles without moving a vertex: edges that lie in two triangles which make a nearly
/// flat quadrilateral are flipped where the other diagonal is better (Delaunay's rule) and no farther off than 0.04
/// even edges; and edges longer than 2.5 even edges are halved, the longest first; until it has no needles. The surface
/// stays closed, manifold and oriented. Precondition: closed and manifold, finite.
DividedNeedles divide_needles(const TriangleMesh& mesh);

}  // namespace gracilis
