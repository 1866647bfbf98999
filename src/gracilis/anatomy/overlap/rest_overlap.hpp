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

/// How far muscles are taken to slide along each other, m: where two overlap at rest, they may be as deep in each other
/// within it.
inline constexpr Real slide_reach = 0.03;

/// Where a free vertex of one of two surfaces lies at rest, and how deep in the other, both m.
struct DepthAtRest {
  Vec3 place;
  Real depth;
};
/// The deepest of those within `slide_reach` of a place, m; 0 where there is none.
Real deepest_around(const std::vector<DepthAtRest>& overlapping, const Vec3& place);

/// That around each vertex of both surfaces. Empty where no free vertex lies in the other.
struct DepthsAround {
  std::vector<float> of_first, of_second;
};

/// The surfaces at rest, in the same coordinates (m), and which of their vertices are free, by index.
struct RestSurface {
  const Points& rest;
  const std::vector<char>& is_free;
};
DepthsAround depths_around(const RestOverlap& overlap, const RestSurface& first, const RestSurface& second);

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
