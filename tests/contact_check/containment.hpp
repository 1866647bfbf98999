#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

namespace gracilis::contact_check {

/// How deep each point lies inside a closed surface (CGAL: Side_of_triangle_mesh, AABB tree): the distance to the
/// nearest point of the surface in m, 0 for points outside or on it.
Eigen::VectorXd depths_inside(const Points& points, const TriangleMesh& closed);

}  // namespace gracilis::contact_check
