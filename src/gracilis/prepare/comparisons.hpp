#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <map>
#include <utility>
#include <vector>

/// What preparation measures of surfaces before and after.
namespace gracilis {

/// Largest and mean distance from the vertices and face centers of one surface to another, m.
struct SurfaceDistance {
  Real largest = 0, mean = 0;
};

SurfaceDistance distance_from_to(const TriangleMesh& from, const TriangleMesh& to);

/// Numbers of pairs of intersecting triangles by pairs of surfaces, whose muscles come first; pairs of two bones are
/// left out.
using Crossings = std::map<std::pair<Index, Index>, Index>;

Crossings count_crossings(const std::vector<TriangleMesh>& muscles, const std::vector<TriangleMesh>& bones);

/// Pairs of intersecting triangles of muscles with other muscles and bones.
Index crossings_between(const std::vector<TriangleMesh>& muscles, const std::vector<TriangleMesh>& bones);

}  // namespace gracilis
