#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

#include <memory>

namespace gracilis::contact_check {

/// A closed surface, made ready to be asked what lies inside it (CGAL: Side_of_triangle_mesh, AABB tree).
class Solid {
 public:
  Solid() = default;  ///< with nothing inside
  /// Also of surfaces that are no manifold. Faces without area are left out.
  explicit Solid(const TriangleMesh& closed);

  /// How deep each point lies inside: the distance to the nearest point of the surface in m, 0 for points outside or on
  /// it. Several threads may ask at once.
  Eigen::VectorXd depths(const Points& points) const;

 private:
  struct Tree;
  std::shared_ptr<const Tree> tree_;
};

}  // namespace gracilis::contact_check
