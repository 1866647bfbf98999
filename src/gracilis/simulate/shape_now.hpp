#pragma once

#include <gracilis/geometry/nearest_points.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <vector>

namespace gracilis {

/// The faces around every vertex of a surface: those of v are faces[offsets[v]] ... faces[offsets[v + 1] - 1],
/// ascending.
struct FacesAround {
  std::vector<Index> offsets, faces;
};
/// Of a surface with so many vertices.
FacesAround faces_around(const Eigen::Matrix3Xi& faces, Index vertex_count);

/// A muscle's surface at one instant, made quickly and asked how far points are from it.
class ShapeNow {
 public:
  /// `faces` and `around` must outlive this; `vertices` too.
  ShapeNow(const Points& vertices, const Eigen::Matrix3Xi& faces, const FacesAround& around);

  /// Distance from p to the nearest of the triangles around the three nearest vertices, m, which is exact where
  /// triangles are not much longer than wide; 0 up to 15 mm behind it, where p is within the muscle. Which side p is on
  /// is told by the vertices' normals; further away these say little.
  Real gap(const Vec3& p) const;

  /// At most the gap.
  Real gap_to_box(const Vec3& p) const { return box_.exteriorDistance(p); }

 private:
  Vec3 normal_at(Index vertex) const;

  const Points& vertices_;
  const Eigen::Matrix3Xi& faces_;
  const FacesAround& around_;
  Eigen::AlignedBox3d box_;
  NearestPoints tree_;
};

}  // namespace gracilis
