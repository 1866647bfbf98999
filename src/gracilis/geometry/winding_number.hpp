#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <array>
#include <vector>

namespace gracilis {

/// Generalized winding numbers of a triangle soup: 1 inside and 0 outside of a closed outward surface, in between where
/// the surface has holes, so that 1/2 still separates inside from outside (Jacobson, Kavan, Sorkine-Hornung 2013). Far
/// groups of triangles are answered by the first three terms of their multipole expansion (Barill et al. 2018); the
/// error stays below 0.01.
class WindingNumber {
 public:
  explicit WindingNumber(const TriangleMesh& mesh);  ///< copies what it needs

  Real query(const Vec3& p) const;  ///< at a point; 0 of no triangles

 private:
  struct Node {
    Vec3 center = Vec3::Zero();       ///< area-weighted
    Vec3 area_vector = Vec3::Zero();  ///< sum of the triangles' area vectors
    Eigen::Matrix3d moment =
        Eigen::Matrix3d::Zero();            ///< sum of (centroid - center) (area vector)ᵀ: how the patch is curved
    std::array<Eigen::Matrix3d, 3> spread;  ///< for each axis: integral of δ δᵀ times that component of the normal
    Real radius = 0;                        ///< of a ball about the center that holds all corners
    Index begin = 0, end = 0;               ///< triangles in `order_`
    Index left = -1, right = -1;            ///< children; -1 in a leaf
  };

  Index build(Index begin, Index end);
  static Real far_share(const Node& node, const Vec3& u, Real distance);
  Vec3 corner(Index triangle, int k) const { return mesh_.vertices.col(mesh_.faces(k, triangle)); }

  TriangleMesh mesh_;
  std::vector<Index> order_;
  std::vector<Node> nodes_;
};

/// Solid angle of triangle (a, b, c) seen from p, over 4π, signed (Van Oosterom and Strackee 1983).
Real solid_angle_share(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace gracilis
