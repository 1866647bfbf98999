#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

#include <string>
#include <vector>

namespace gracilis {

/// A surface made closed, manifold and oriented, and what that took; clauses such as "filled 1 hole".
struct FixedSurface {
  TriangleMesh mesh;
  std::vector<std::string> repairs;
};

/// Repairs any triangle surface, in this order: what geometry/mesh_repair.hpp does; where that is not enough, equal
/// vertices are merged, doubled faces dropped and sheets that meet in a vertex or an edge separated; pieces with less
/// than `crumb_share` of the area are dropped; holes are filled; faces turned outwards; self-intersections removed. A
/// sound surface comes back as it is. Throws InputError naming `name` when nothing is left or the surface cannot be
/// made closed and manifold.
FixedSurface fix_surface(const TriangleMesh& mesh, const std::string& name, Real crumb_share = 0.01);

/// The connected pieces of a surface, largest area first.
std::vector<TriangleMesh> pieces_of(const TriangleMesh& mesh);

/// All surfaces in one mesh, one after the other.
TriangleMesh merged(const std::vector<TriangleMesh>& meshes);

}  // namespace gracilis
