#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <optional>
#include <vector>

/// Between our meshes and CGAL's; for this folder's cgal_*.cpp only.
namespace gracilis {

using CgalKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalPoint = CgalKernel::Point_3;
using CgalMesh = CGAL::Surface_mesh<CgalPoint>;

inline CgalPoint to_cgal(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

/// None where CGAL's half-edge structure cannot take a face (a third one at an edge, or a vertex twice).
inline std::optional<CgalMesh> to_cgal(const TriangleMesh& mesh) {
  CgalMesh result;
  std::vector<CgalMesh::Vertex_index> vertices;
  for (Index v = 0; v < mesh.vertex_count(); ++v) vertices.push_back(result.add_vertex(to_cgal(mesh.vertices.col(v))));
  const auto at = [&](Index f, int k) { return vertices[static_cast<std::size_t>(mesh.faces(k, f))]; };
  for (Index f = 0; f < mesh.face_count(); ++f)
    if (result.add_face(at(f, 0), at(f, 1), at(f, 2)) == CgalMesh::null_face()) return std::nullopt;
  return result;
}

inline TriangleMesh from_cgal(const CgalMesh& mesh) {
  TriangleMesh result;
  result.vertices.resize(3, static_cast<Index>(mesh.number_of_vertices()));
  result.faces.resize(3, static_cast<Index>(mesh.number_of_faces()));
  std::vector<Index> number(mesh.num_vertices(), -1);  // removed ones are counted here, too
  Index count = 0;
  for (const auto v : mesh.vertices()) {
    const CgalPoint& p = mesh.point(v);
    result.vertices.col(count) << p.x(), p.y(), p.z();
    number[static_cast<std::size_t>(v)] = count++;
  }
  count = 0;
  for (const auto f : mesh.faces()) {
    int k = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
      result.faces(k++, count) = number[static_cast<std::size_t>(v)];
    ++count;
  }
  return result;
}

}  // namespace gracilis
