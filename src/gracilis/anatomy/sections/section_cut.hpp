#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

#include <vector>

namespace gracilis {

/// Where a ray in a section's plane passes through a surface.
struct RayHit {
  Real distance = 0;  ///< m, along the ray
  bool back = false;  ///< the ray leaves the surface: it meets the triangle's back
};

/// What a section's plane cuts out of a closed surface, in plane coordinates about a center. All rays of a section lie
/// in its plane, so that rays against triangles become rays against these segments (Laclé 2014, section 3.5.3.1).
class SectionCut {
 public:
  /// The plane through `center` along the unit vectors `x` and `y`, perpendicular to each other.
  SectionCut(const TriangleMesh& surface, const Vec3& center, const Vec3& x, const Vec3& y);

  bool empty() const { return segments_.empty(); }  ///< the plane misses the surface

  /// All hits of the ray from `from` in the unit direction `along` (plane coordinates), nearest first. Surfaces without
  /// holes are met as often from the front as from the back by a ray that begins outside.
  std::vector<RayHit> hits(const Eigen::Vector2d& from, const Eigen::Vector2d& along) const;

  /// The curves that the plane cuts, 2 × points each, the inside to the left; the first point is not repeated. Points
  /// that coincide are one.
  std::vector<Eigen::Matrix2Xd> outlines() const;

  /// Whether a point of the plane lies inside.
  bool contains(const Eigen::Vector2d& point) const;

 private:
  struct Segment {
    Eigen::Vector2d from, to;  ///< the inside lies to the left
  };
  std::vector<Segment> segments_;
};

}  // namespace gracilis
