#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

#include <array>
#include <vector>

/// Which parts of surfaces cut each other, decided by CGAL's exact predicates. Shares no code with the solver.
/// Touching counts as cutting. Faces without area are left out.
namespace gracilis::contact_check {

using IndexPair = std::array<Index, 2>;
using Edges = std::vector<IndexPair>;

/// Pairs (face of one, face of other) that have a point in common, ascending.
std::vector<IndexPair> intersecting_faces(const TriangleMesh& one, const TriangleMesh& other);

/// Pairs (lower, higher face) of one surface that have a point in common other than the vertex or edge they share,
/// ascending; faces on the same three vertices are such a pair.
std::vector<IndexPair> self_intersecting_faces(const TriangleMesh& mesh);

/// Every edge once, lower vertex first, ascending.
Edges edges_of(const TriangleMesh& mesh);

/// The edges (as indices, ascending) that have a point in common with a face of the other surface.
std::vector<Index> crossing_edges(const Points& points, const Edges& edges, const TriangleMesh& other);

}  // namespace gracilis::contact_check
