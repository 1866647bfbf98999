#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <vector>

namespace gracilis {

/// Mean value coordinates of points with respect to a closed surface (Ju, Schaefer and Warren 2005): weights w of its
/// vertices x with Σ w = 1 and Σ w x = p, smooth in p, so that what the vertices are given goes on smoothly inside.
/// They reproduce affine maps of the surface. Points on the surface get the barycentric coordinates of their triangle.
class MeanValueCoordinates {
 public:
  /// Precondition: the surface is closed and has a volume. Keeps a copy.
  explicit MeanValueCoordinates(const TriangleMesh& surface);

  /// The weights of all vertices for p; n. May run at the same time for different points.
  Eigen::VectorXd weights(const Vec3& p) const;

 private:
  TriangleMesh surface_;
  std::vector<Eigen::Vector2i> edges_;
  Eigen::Matrix3Xi face_edges_;  ///< per face: the edge opposite to each of its corners
};

}  // namespace gracilis
