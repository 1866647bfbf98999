#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/prepare/time_limit.hpp>

#include <optional>
#include <span>
#include <vector>

/// What this component asks of CGAL, in our own types. One .cpp per header family: each costs its compiler a minute and
/// gigabytes. CGAL's own checks are compiled in, so what it cannot do comes back as such instead of as a crash.
namespace gracilis {

/// Two triangles that meet where they should not.
struct FacePair {
  Index mesh_a = 0, face_a = 0;  ///< (mesh_a, face_a) < (mesh_b, face_b)
  Index mesh_b = 0, face_b = 0;
};

/// All pairs of triangles that intersect, by exact predicates; within one mesh, what neighbors share by their indices
/// does not count. With `between_only` pairs within one mesh are not looked for. Ordered. Coordinates must be finite
/// and indices in range; surfaces may be open, not manifold or not oriented.
std::vector<FacePair> intersecting_faces(std::span<const TriangleMesh* const> meshes, bool between_only = false,
                                         const TimeLimit& limit = TimeLimit());

/// A triangle soup made a manifold surface with neighbors that agree: equal vertices merged, faces without area and
/// doubled faces dropped, vertices and edges at which more than one sheet meets split between the sheets. Empty where
/// CGAL cannot do it.
TriangleMesh manifold_of_soup(const TriangleMesh& soup);

/// Fills every hole whose boundary is no longer than `longest` (m) with a patch of about the density around, a fair one
/// where `fair`. Returns the number of holes filled; a hole that cannot be filled stays. The surface should be manifold
/// and oriented; of another nothing is filled.
Index fill_holes(TriangleMesh& mesh, Real longest, bool fair = true, const TimeLimit& limit = TimeLimit());

/// Isotropic remeshing: edges about `edge_length` (m) long, vertices projected to the input surface (Botsch and Kobbelt
/// 2004). None where the surface is not closed and manifold or CGAL cannot do it.
std::optional<TriangleMesh> remesh_isotropic(const TriangleMesh& mesh, Real edge_length, int iterations,
                                             const TimeLimit& limit = TimeLimit());

/// A closed surface without most of its slivers: edges shorter than `shortest` (m) are collapsed, and triangles that
/// are nearly lines flipped away, as long as no triangle turns over; what is at the vertices marked in `kept` (one per
/// vertex) stays. None where the surface is not closed or CGAL cannot do it. It may cut itself where it did not before.
std::optional<TriangleMesh> without_slivers(const TriangleMesh& mesh, Real shortest, const std::vector<char>& kept);

/// The surface of what either of two solids encloses. None where a surface is not closed, or cuts itself, or CGAL
/// cannot do it.
std::optional<TriangleMesh> exact_union(const TriangleMesh& a, const TriangleMesh& b,
                                        const TimeLimit& limit = TimeLimit());

}  // namespace gracilis
