#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <vector>

namespace gracilis {

/// The smallest box along the axes that holds all points. Precondition: there are some.
Eigen::AlignedBox3d bounding_box(const Points& points);

/// Root mean square of the distances from the points' mean, m. Precondition: there are some.
Real extent_of(const Points& points);

/// Twice the area times the outward unit normal of face `face`: \f$(b - a) \times (c - a)\f$.
Vec3 area_vector(const Points& vertices, const Eigen::Vector3i& corners);

/// Area of the triangles at an edge, m².
Real area_at(const MeshEdge& edge, const Points& vertices, const Eigen::Matrix3Xi& faces);

/// The mean length of edges, m; 0 where there are none.
Real mean_edge_length(const std::vector<MeshEdge>& edges, const Points& vertices);

/// Signed volume enclosed by a closed surface, m³, positive when oriented outwards. By the divergence theorem it is
/// \f$V = \frac{1}{6} \sum a \cdot (b \times c)\f$ over all faces (a, b, c), taken about the first vertex to keep
/// digits.
Real enclosed_volume(const Points& vertices, const Eigen::Matrix3Xi& faces);

/// Area of the surface, m².
Real surface_area(const Points& vertices, const Eigen::Matrix3Xi& faces);

/// A third of the area of the triangles around each vertex, m²; sums to the surface's area.
Eigen::VectorXd vertex_areas(const Points& vertices, const Eigen::Matrix3Xi& faces);

}  // namespace gracilis
