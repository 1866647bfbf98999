#pragma once

#include <gracilis/core/types.hpp>

#include <array>
#include <vector>

namespace gracilis {

/// An edge of a surface with the triangles on its two sides.
struct MeshEdge {
  Index a = -1, b = -1;                   ///< end vertices, a < b
  Index left = -1, right = -1;            ///< faces in which the edge runs a→b and b→a; -1 where there is none
  Index left_apex = -1, right_apex = -1;  ///< the vertices of those faces opposite to the edge
};

/// Neighbors of every vertex as offset + index: those of v are neighbors[offsets[v]] ... neighbors[offsets[v + 1] - 1].
struct VertexStars {
  std::vector<Index> offsets;    ///< n + 1
  std::vector<Index> neighbors;  ///< ascending for each vertex
};

struct MeshTopology {
  std::vector<MeshEdge> edges;  ///< ordered by (a, b)
  VertexStars stars;
};

/// Edges and neighborhoods of a triangle list over `vertex_count` vertices. Open edges have one side -1. Of an edge
/// shared by more than two faces only the first two sides are kept; inspection refuses such surfaces for muscles
/// before.
MeshTopology build_topology(const Eigen::Matrix3Xi& faces, Index vertex_count);

/// True when every edge has exactly one face on each side, so that inside and outside are well defined.
bool is_closed(const Eigen::Matrix3Xi& faces);

/// A renumbering by breadth-first search over the stars: order[new] = old. Neighbors in space become neighbors in
/// memory.
std::vector<Index> breadth_first_order(const VertexStars& stars);

}  // namespace gracilis
