#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <span>
#include <vector>

/// What this component asks of CGAL, in our own types. One .cpp per header family: each costs its compiler a minute and
/// gigabytes.
namespace gracilis {

/// Two triangles that meet where they should not.
struct FacePair {
  Index mesh_a = 0, face_a = 0;  ///< (mesh_a, face_a) < (mesh_b, face_b)
  Index mesh_b = 0, face_b = 0;
};

/// All pairs of triangles that intersect, by exact predicates; within one mesh, what neighbors share by their indices
/// does not count. With `between_only` pairs within one mesh are not looked for. Ordered. Coordinates must be finite
/// and indices in range; surfaces may be open, not manifold or not oriented.
std::vector<FacePair> intersecting_faces(std::span<const TriangleMesh* const> meshes, bool between_only = false);

/// A triangle soup made a manifold surface with neighbors that agree: equal vertices merged, faces without area and
/// doubled faces dropped, vertices and edges at which more than one sheet meets split between the sheets.
TriangleMesh manifold_of_soup(const TriangleMesh& soup);

/// Fills every hole whose boundary is no longer than `longest` (m) with a fair patch of about the density around.
/// Returns the number of holes filled. The surface must be manifold and oriented.
Index fill_holes(TriangleMesh& mesh, Real longest);

/// Replaces the surroundings of triangles that cut each other by surfaces that do not. True when none are left. The
/// surface must be closed and manifold; parts may become disconnected.
bool remove_self_intersections(TriangleMesh& mesh);

/// Isotropic remeshing: edges about `edge_length` (m) long, vertices projected to the input surface (Botsch and Kobbelt
/// 2004). The surface must be manifold; its boundary, if any, is remeshed with it.
TriangleMesh remesh_isotropic(const TriangleMesh& mesh, Real edge_length, int iterations);

}  // namespace gracilis
