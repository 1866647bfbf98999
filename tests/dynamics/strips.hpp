#pragma once

#include <shapes.hpp>

#include <vector>

/// Surfaces whose vertices lie where one can count them.
namespace gracilis {

/// A band of squares in two triangles each: column i has the vertices 2 i at `columns[i]` and 2 i + 1 at 1 mm beside it
/// along y.
inline TriangleMesh strip(const std::vector<Vec3>& columns) {
  std::vector<Vec3> vertices;
  std::vector<Eigen::Vector3i> faces;
  for (const Vec3& column : columns) vertices.insert(vertices.end(), {column, column + Vec3(0, 0.001, 0)});
  for (int i = 0; i + 2 < static_cast<int>(vertices.size()); i += 2)
    faces.insert(faces.end(), {{i, i + 2, i + 1}, {i + 1, i + 2, i + 3}});
  return shapes::mesh_of(vertices, faces);
}

/// A straight strip along x, columns 1 mm apart.
inline TriangleMesh straight_strip(int columns, Real z = 0) {
  std::vector<Vec3> line;
  for (int i = 0; i < columns; ++i) line.emplace_back(0.001 * i, 0, z);
  return strip(line);
}

/// Vertex 0 at `tip`, the others 200 mm above it.
inline TriangleMesh tetrahedron(const Vec3& tip) {
  return shapes::mesh_of({tip, tip + Vec3(0.01, 0, 0.2), tip + Vec3(-0.01, 0.01, 0.2), tip + Vec3(-0.01, -0.01, 0.2)},
                         {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}});
}

}  // namespace gracilis
