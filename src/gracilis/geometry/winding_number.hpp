#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <vector>

namespace gracilis {

/// Generalized winding numbers of a triangle soup: 1 inside and 0 outside of a closed outward surface, in between where
/// the surface has holes, so that 1/2 still separates inside from outside (Jacobson, Kavan, Sorkine-Hornung 2013). Far
/// groups of triangles are answered by the first term of their multipole expansion (Barill et al. 2018); the error
/// stays below 0.02.
class WindingNumber {
 public:
  explicit WindingNumber(const TriangleMesh& mesh);

  Real query(const Vec3& p) const;

 private:
  struct Node {
    Vec3 center = Vec3::Zero();       ///< area-weighted
    Vec3 area_vector = Vec3::Zero();  ///< sum of the triangles' area vectors
    Real radius = 0;                  ///< of a ball about the center that holds all corners
    Index begin = 0, end = 0;         ///< triangles in `order_`
    Index left = -1, right = -1;      ///< children; -1 in a leaf
  };

  Index build(Index begin, Index end);
  Vec3 corner(Index triangle, int k) const { return mesh_.vertices.col(mesh_.faces(k, triangle)); }

  TriangleMesh mesh_;
  std::vector<Index> order_;
  std::vector<Node> nodes_;
};

/// Solid angle of triangle (a, b, c) seen from p, over 4π, signed (Van Oosterom and Strackee 1983).
Real solid_angle_share(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace gracilis
