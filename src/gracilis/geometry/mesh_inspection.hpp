#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <vector>

namespace gracilis {

/// How often one kind of defect occurs, and where first.
struct MeshDefect {
  Index count = 0;
  Index first = -1;  ///< a vertex for defects of vertices, otherwise a face; -1: none

  explicit operator bool() const { return count > 0; }  ///< whether there is any
  /// Counts one more; the first one is remembered.
  void add(Index element) {
    if (count++ == 0) first = element;
  }
};

/// Everything about a surface that decides whether it can be used.
struct MeshReport {
  Index vertex_count = 0;
  Index face_count = 0;

  // When one of these two occurs, nothing below is computed.
  MeshDefect out_of_range_faces;   ///< naming a vertex that does not exist
  MeshDefect non_finite_vertices;  ///< a coordinate is NaN or infinite

  MeshDefect duplicate_vertices;     ///< at the place of an earlier vertex (to 1e-9 of the bounding box)
  MeshDefect unreferenced_vertices;  ///< in no face
  MeshDefect degenerate_faces;       ///< a vertex named twice, or height below 1e-12 of the longest edge
  MeshDefect open_edges;             ///< with one face
  MeshDefect non_manifold_edges;     ///< with more than two faces
  MeshDefect inconsistent_edges;     ///< with two faces that run through it in the same direction
  MeshDefect pinched_vertices;  ///< whose faces form more than one fan: parts of the surface touch there in a point

  Index components = 0;     ///< pieces of faces connected through vertices
  Vec3 low = Vec3::Zero();  ///< corner of the bounding box of all vertices, m
  Vec3 high = Vec3::Zero();
  Real area = 0;     ///< m²
  Real volume = 0;   ///< m³, signed; means something only for a closed surface
  Index genus = -1;  ///< number of handles, all components together; -1 unless closed and manifold

  Real diagonal() const { return (high - low).norm(); }  ///< m, of the bounding box
  /// Every vertex, and every index is that of one.
  bool is_finite() const { return !out_of_range_faces && !non_finite_vertices; }
  /// Each edge between two faces.
  bool is_closed() const { return is_finite() && face_count > 0 && !open_edges && !non_manifold_edges; }
  /// A surface at every edge and vertex.
  bool is_manifold() const { return is_finite() && !non_manifold_edges && !pinched_vertices; }
  bool is_oriented() const { return is_finite() && !inconsistent_edges; }  ///< neighbors face the same way
};

/// Inspects any surface, however broken; never throws.
MeshReport inspect_mesh(const TriangleMesh& mesh);

/// True when the face names a vertex twice or has (nearly) no area.
bool is_degenerate(const TriangleMesh& mesh, Index face);

/// For every vertex the first vertex at the same place (to 1e-9 of the bounding box): itself unless it is a duplicate.
/// Coordinates must be finite.
std::vector<Index> first_at_same_place(const Points& vertices);

/// For every vertex the number of its component, counted from 0 in order of first appearance; -1 in no face. Indices
/// must be in range.
std::vector<Index> component_of_vertices(const TriangleMesh& mesh);

/// How many there are, of vertices numbered that way.
Index component_count(const std::vector<Index>& component);

}  // namespace gracilis
