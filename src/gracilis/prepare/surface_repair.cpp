#include <gracilis/prepare/surface_repair.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/mesh_inspection.hpp>
#include <gracilis/geometry/mesh_repair.hpp>
#include <gracilis/prepare/cgal.hpp>

#include <algorithm>
#include <array>

namespace gracilis {

static std::string counted(Index count, const std::string& thing, const std::string& things) {
  return std::to_string(count) + " " + (count == 1 ? thing : things);
}

static bool is_solid(const MeshReport& report) {
  return report.is_closed() && report.is_manifold() && report.is_oriented() && !report.degenerate_faces;
}

static Index self_intersection_count(const TriangleMesh& mesh) {
  const std::array<const TriangleMesh*, 1> one = {&mesh};
  return static_cast<Index>(intersecting_faces(one).size());
}

static void take(RepairedMesh repaired, FixedSurface& fixed) {
  fixed.mesh = std::move(repaired.mesh);
  for (const std::string& repair : repaired.repairs) fixed.repairs.push_back(repair);
}

/// Only faces count: vertices that no face names are left behind.
static void make_manifold(FixedSurface& fixed) {
  const MeshReport before = inspect_mesh(fixed.mesh);
  fixed.mesh = manifold_of_soup(fixed.mesh);
  if (before.non_manifold_edges)
    fixed.repairs.push_back("separated the sheets at " + counted(before.non_manifold_edges.count, "edge", "edges") +
                            " with more than two faces");
  if (before.pinched_vertices)
    fixed.repairs.push_back("separated the parts that met at " +
                            counted(before.pinched_vertices.count, "vertex", "vertices"));
  if (!before.non_manifold_edges && !before.pinched_vertices)
    fixed.repairs.push_back("rebuilt how the faces hang together");
}

static void fill(FixedSurface& fixed) {
  if (!inspect_mesh(fixed.mesh).open_edges) return;
  const Index filled = fill_holes(fixed.mesh, std::numeric_limits<Real>::max());
  if (filled > 0) fixed.repairs.push_back("filled " + counted(filled, "hole", "holes"));
}

static void untangle(FixedSurface& fixed, Real crumb_share) {
  const Index before = self_intersection_count(fixed.mesh);
  if (before == 0) return;
  const bool clean = remove_self_intersections(fixed.mesh);
  take(repair_mesh(fixed.mesh, crumb_share), fixed);
  fixed.repairs.push_back(
      (clean ? "removed " : "tried to remove ") +
      counted(before, "pair of triangles that cut each other", "pairs of triangles that cut each other"));
}

FixedSurface fix_surface(const TriangleMesh& mesh, const std::string& name, Real crumb_share) {
  if (mesh.face_count() == 0) throw InputError({name, "", "holds no faces", "export a triangle surface"});
  const MeshReport as_given = inspect_mesh(mesh);
  if (!as_given.is_finite())
    throw InputError({name, "", "has coordinates that are not finite or faces that name vertices it does not have",
                      "export the surface again"});
  FixedSurface fixed;
  take(repair_mesh(mesh, crumb_share), fixed);
  if (!is_solid(inspect_mesh(fixed.mesh))) {
    make_manifold(fixed);
    take(repair_mesh(fixed.mesh, crumb_share), fixed);
    fill(fixed);
    take(repair_mesh(fixed.mesh, crumb_share), fixed);
  }
  if (fixed.mesh.face_count() == 0 || !is_solid(inspect_mesh(fixed.mesh)))
    throw InputError({name, "", "cannot be made a closed surface", "rebuild it in a mesh editor"});
  untangle(fixed, crumb_share);
  return fixed;
}

std::vector<TriangleMesh> pieces_of(const TriangleMesh& mesh) {
  const std::vector<Index> component = component_of_vertices(mesh);
  const Index count = component.empty() ? 0 : 1 + *std::max_element(component.begin(), component.end());
  std::vector<TriangleMesh> pieces;
  for (Index c = 0; c < count; ++c) {
    TriangleMesh piece{mesh.vertices, mesh.faces};
    std::vector<Index> renumbered(component.size(), -1);
    Index vertices = 0, faces = 0;
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      if (component[static_cast<std::size_t>(v)] == c) {
        piece.vertices.col(vertices) = mesh.vertices.col(v);
        renumbered[static_cast<std::size_t>(v)] = vertices++;
      }
    for (Index f = 0; f < mesh.face_count(); ++f)
      if (component[static_cast<std::size_t>(mesh.faces(0, f))] == c) {
        for (int k = 0; k < 3; ++k) piece.faces(k, faces) = renumbered[static_cast<std::size_t>(mesh.faces(k, f))];
        ++faces;
      }
    piece.vertices.conservativeResize(3, vertices);
    piece.faces.conservativeResize(3, faces);
    pieces.push_back(std::move(piece));
  }
  std::stable_sort(pieces.begin(), pieces.end(), [](const TriangleMesh& l, const TriangleMesh& r) {
    return surface_area(l.vertices, l.faces) > surface_area(r.vertices, r.faces);
  });
  return pieces;
}

TriangleMesh merged(const std::vector<TriangleMesh>& meshes) {
  TriangleMesh all;
  for (const TriangleMesh& mesh : meshes) {
    const Index vertices = all.vertex_count(), faces = all.face_count();
    all.vertices.conservativeResize(3, vertices + mesh.vertex_count());
    all.vertices.rightCols(mesh.vertex_count()) = mesh.vertices;
    all.faces.conservativeResize(3, faces + mesh.face_count());
    all.faces.rightCols(mesh.face_count()) = (mesh.faces.array() + vertices).matrix();
  }
  return all;
}

}  // namespace gracilis
