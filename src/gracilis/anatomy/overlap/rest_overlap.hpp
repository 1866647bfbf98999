#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/scene/scene.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace gracilis {

/// The vertices of one surface that lie inside another.
struct InsideVertices {
  std::vector<Index> vertices;    ///< ascending
  std::vector<Real> depths;       ///< m, above 0
  Points outward = Points(3, 0);  ///< unit, from each to the nearest point of the other surface; 0 where it lies on it

  /// In m; 0 where none is inside.
  Real deepest() const { return depths.empty() ? 0 : *std::max_element(depths.begin(), depths.end()); }
};

/// Two surfaces of which at least one has vertices inside the other.
struct RestOverlap {
  Index first = 0, second = 0;  ///< surfaces, first < second
  InsideVertices of_first, of_second;

  Real deepest() const { return std::max(of_first.deepest(), of_second.deepest()); }  ///< m, of both
};

/// The deepest of those vertices of both for which is_free(surface, vertex), m; 0 where there is none.
template <class IsFree>
Real deepest_free(const RestOverlap& overlap, const IsFree& is_free) {
  Real deepest = 0;
  const auto look_at = [&](Index surface, const InsideVertices& inside) {
    for (std::size_t i = 0; i < inside.vertices.size(); ++i)
      if (is_free(surface, inside.vertices[i])) deepest = std::max(deepest, inside.depths[i]);
  };
  look_at(overlap.first, overlap.of_first);
  look_at(overlap.second, overlap.of_second);
  return deepest;
}

/// Which surfaces overlap, by exact distances in double precision (SignedDistance), in the order of pairs. Overlaps
/// without a vertex inside are not seen. Precondition: closed surfaces, oriented outwards, finite.
std::vector<RestOverlap> rest_overlaps(const std::vector<TriangleMesh>& surfaces);

/// The same of a scene's muscles in the capture pose.
std::vector<RestOverlap> rest_overlaps(const Scene& scene);

/// Free vertices of a muscle that lie inside a bone.
struct BoneOverlap {
  Index muscle = 0, bone = 0;
  InsideVertices inside;
};

/// Which muscles of a scene lie in bones in the capture pose, likewise; attached vertices may.
std::vector<BoneOverlap> rest_overlaps_with_bones(const Scene& scene);

/// Of all surfaces together how many vertices lie in at least one other.
Index count_inside(const std::vector<RestOverlap>& overlaps);

}  // namespace gracilis
