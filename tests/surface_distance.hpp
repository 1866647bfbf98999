#pragma once

#include <gracilis/geometry/nearest_triangle.hpp>

#include <algorithm>

namespace gracilis {

/// How far the vertices of one surface are from another at most, m; of both ways the larger is the Hausdorff distance.
inline Real farthest_from(const TriangleMesh& to, const TriangleMesh& from) {
  const NearestTriangle nearest(to);
  Real distance = 0;
  for (Index v = 0; v < from.vertex_count(); ++v)
    distance = std::max(distance, nearest.query(from.vertices.col(v)).distance);
  return distance;
}

}  // namespace gracilis
