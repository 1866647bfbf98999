#include <gracilis/geometry/mesh_pieces.hpp>

#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/mesh_inspection.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

std::vector<TriangleMesh> pieces_of(const TriangleMesh& mesh) {
  const std::vector<Index> component = component_of_vertices(mesh);
  const auto of = [&](Index v) { return component[static_cast<std::size_t>(v)]; };
  const Index count = component_count(component);
  std::vector<TriangleMesh> pieces(static_cast<std::size_t>(count));
  std::vector<Index> vertices(pieces.size(), 0), faces(pieces.size(), 0), number(component.size(), -1);
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (of(v) >= 0) number[static_cast<std::size_t>(v)] = vertices[static_cast<std::size_t>(of(v))]++;
  for (Index f = 0; f < mesh.face_count(); ++f) ++faces[static_cast<std::size_t>(of(mesh.faces(0, f)))];
  for (std::size_t c = 0; c < pieces.size(); ++c) {
    pieces[c].vertices.resize(3, vertices[c]);
    pieces[c].faces.resize(3, faces[c]);
    faces[c] = 0;
  }
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (of(v) >= 0)
      pieces[static_cast<std::size_t>(of(v))].vertices.col(number[static_cast<std::size_t>(v)]) = mesh.vertices.col(v);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto c = static_cast<std::size_t>(of(mesh.faces(0, f)));
    for (int k = 0; k < 3; ++k) pieces[c].faces(k, faces[c]) = number[static_cast<std::size_t>(mesh.faces(k, f))];
    ++faces[c];
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

TriangleMesh largest_piece(const TriangleMesh& mesh) {
  const std::vector<TriangleMesh> pieces = pieces_of(mesh);
  if (pieces.size() < 2) return mesh;
  const auto volume = [](const TriangleMesh& piece) { return std::abs(enclosed_volume(piece.vertices, piece.faces)); };
  return *std::max_element(pieces.begin(), pieces.end(),
                           [&](const TriangleMesh& l, const TriangleMesh& r) { return volume(l) < volume(r); });
}

}  // namespace gracilis
