#pragma once

#include <gracilis/core/types.hpp>

#include <span>
#include <vector>

namespace gracilis {

/// One side of an edge, in one face.
struct HalfEdge {
  Index low = 0, high = 0;  ///< the edge's vertices, low < high
  Index face = 0;
  Index apex = 0;       ///< the face's third vertex
  bool forward = true;  ///< the face runs from low to high
};

/// All half-edges sorted by (low, high, face), so that the sides of an edge lie together whatever their number. Faces
/// that name a vertex twice have none of the edge between equal vertices. No vertex may be negative. Takes time in
/// proportion to faces and vertices where few edges meet in one vertex.
std::vector<HalfEdge> sorted_half_edges(const Eigen::Matrix3Xi& faces);

/// Calls body(sides) for every edge, in order.
template <typename Body>
void for_each_edge(std::span<const HalfEdge> half_edges, const Body& body) {
  for (std::size_t begin = 0; begin < half_edges.size();) {
    std::size_t end = begin + 1;
    while (end < half_edges.size() && half_edges[end].low == half_edges[begin].low &&
           half_edges[end].high == half_edges[begin].high) {
      ++end;
    }
    body(half_edges.subspan(begin, end - begin));
    begin = end;
  }
}

}  // namespace gracilis
