#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

#include <cmath>
#include <map>
#include <utility>
#include <vector>

/// Small named surfaces with known answers, shared by all tests.
namespace gracilis::shapes {

inline constexpr Real mm = 0.001;  ///< m

inline TriangleMesh mesh_of(const std::vector<Vec3>& vertices, const std::vector<Eigen::Vector3i>& faces) {
  TriangleMesh mesh;
  mesh.vertices.resize(3, static_cast<Index>(vertices.size()));
  mesh.faces.resize(3, static_cast<Index>(faces.size()));
  for (std::size_t i = 0; i < vertices.size(); ++i) mesh.vertices.col(static_cast<Index>(i)) = vertices[i];
  for (std::size_t i = 0; i < faces.size(); ++i) mesh.faces.col(static_cast<Index>(i)) = faces[i];
  return mesh;
}

/// Axis-aligned box from `low` to `high`: 8 vertices, 12 faces, outward.
inline TriangleMesh box(const Vec3& low, const Vec3& high) {
  std::vector<Vec3> v;
  for (int c = 0; c < 8; ++c)
    v.emplace_back((c & 1) ? high.x() : low.x(), (c & 2) ? high.y() : low.y(), (c & 4) ? high.z() : low.z());
  return mesh_of(v, {{0, 2, 1},
                     {1, 2, 3},
                     {4, 5, 6},
                     {5, 7, 6},
                     {0, 1, 4},
                     {1, 5, 4},
                     {2, 6, 3},
                     {3, 6, 7},
                     {0, 4, 2},
                     {2, 4, 6},
                     {1, 3, 5},
                     {3, 7, 5}});
}

/// Octahedron subdivided `levels` times and projected to a sphere: 8 · 4^levels faces, outward.
inline TriangleMesh sphere(const Vec3& center, Real radius, int levels) {
  std::vector<Vec3> v = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<Eigen::Vector3i> f = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                    {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [it, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<int>(v.size()));
      if (fresh) v.push_back((v[static_cast<std::size_t>(a)] + v[static_cast<std::size_t>(b)]).normalized());
      return it->second;
    };
    std::vector<Eigen::Vector3i> finer;
    for (const auto& t : f) {
      const int ab = middle(t[0], t[1]), bc = middle(t[1], t[2]), ca = middle(t[2], t[0]);
      finer.insert(finer.end(), {{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}});
    }
    f = finer;
  }
  for (Vec3& p : v) p = center + radius * p;
  return mesh_of(v, f);
}

/// A closed tube along +z from z = 0 to `length` with flat ends: `around` vertices per ring, `along` rings of faces.
inline TriangleMesh cylinder(Real radius, Real length, int around, int along) {
  std::vector<Vec3> v;
  std::vector<Eigen::Vector3i> f;
  for (int k = 0; k <= along; ++k)
    for (int i = 0; i < around; ++i) {
      const Real angle = 2 * pi * i / around;
      v.emplace_back(radius * std::cos(angle), radius * std::sin(angle), length * k / along);
    }
  const auto at = [&](int i, int k) { return k * around + i % around; };
  for (int k = 0; k < along; ++k)
    for (int i = 0; i < around; ++i) {
      f.emplace_back(at(i, k), at(i + 1, k), at(i + 1, k + 1));
      f.emplace_back(at(i, k), at(i + 1, k + 1), at(i, k + 1));
    }
  const int bottom = static_cast<int>(v.size()), top = bottom + 1;
  v.emplace_back(0, 0, 0), v.emplace_back(0, 0, length);
  for (int i = 0; i < around; ++i) {
    f.emplace_back(bottom, at(i + 1, 0), at(i, 0));
    f.emplace_back(top, at(i, along), at(i + 1, along));
  }
  return mesh_of(v, f);
}

/// One mesh of two.
inline TriangleMesh both(const TriangleMesh& first, const TriangleMesh& second) {
  TriangleMesh mesh{Points(3, first.vertex_count() + second.vertex_count()),
                    Eigen::Matrix3Xi(3, first.face_count() + second.face_count())};
  mesh.vertices << first.vertices, second.vertices;
  mesh.faces << first.faces, second.faces.array() + first.vertex_count();
  return mesh;
}

}  // namespace gracilis::shapes
