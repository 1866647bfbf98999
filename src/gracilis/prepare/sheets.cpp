#include <gracilis/prepare/sheets.hpp>

#include <gracilis/geometry/disjoint_sets.hpp>
#include <gracilis/geometry/half_edges.hpp>
#include <gracilis/geometry/mesh_inspection.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace gracilis {
namespace {

constexpr Real drawn_in = 0.05;  ///< of the way to the mean of the neighbors

/// A face at an edge, seen along the edge from its lower vertex to its higher one.
struct Leaf {
  Real angle = 0;
  bool opens = false;  ///< going around, the solid begins behind it; otherwise it ends there
  Index face = 0;
};

/// In the order around the edge. Where two lie in each other, a solid ends before the next begins.
std::vector<Leaf> leaves_around(const TriangleMesh& mesh, std::span<const HalfEdge> sides) {
  const Vec3 low = mesh.vertices.col(sides[0].low);
  const Vec3 along = (mesh.vertices.col(sides[0].high) - low).normalized();
  const Vec3 x = along.unitOrthogonal(), y = along.cross(x);
  std::vector<Leaf> leaves;
  for (const HalfEdge& side : sides) {
    const Vec3 apex = mesh.vertices.col(side.apex) - low;
    leaves.push_back({std::atan2(apex.dot(y), apex.dot(x)), !side.forward, side.face});
  }
  std::sort(leaves.begin(), leaves.end(), [](const Leaf& l, const Leaf& r) {
    return std::tie(l.angle, l.opens, l.face) < std::tie(r.angle, r.opens, r.face);
  });
  return leaves;
}

/// Pairs of faces with a solid between them, as brackets around a circle.
std::vector<std::pair<Index, Index>> neighbors_at(const TriangleMesh& mesh, std::span<const HalfEdge> sides) {
  if (sides.size() < 2) return {};
  if (sides.size() == 2) return {{sides[0].face, sides[1].face}};
  const std::vector<Leaf> leaves = leaves_around(mesh, sides);
  std::vector<char> paired(leaves.size(), 0);
  std::vector<std::size_t> open;
  std::vector<std::pair<Index, Index>> pairs;
  for (std::size_t i = 0; i < 2 * leaves.size(); ++i) {
    const std::size_t k = i % leaves.size();
    if (leaves[k].opens && i == k) open.push_back(k);
    if (leaves[k].opens || paired[k] || open.empty()) continue;
    pairs.emplace_back(leaves[open.back()].face, leaves[k].face);
    paired[k] = 1;
    open.pop_back();
  }
  return pairs;
}

/// The corner of the face at that vertex.
Index corner_at(const TriangleMesh& mesh, Index face, Index vertex) {
  for (Index k = 0; k < 3; ++k)
    if (mesh.faces(k, face) == vertex) return 3 * face + k;
  return -1;
}

/// Vertices that share their place with another one of their piece move to their own neighbors.
void draw_apart(TriangleMesh& mesh, const std::vector<Index>& origin) {
  const std::vector<Index> piece = component_of_vertices(mesh);
  std::vector<std::pair<Index, Index>> keys;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    keys.emplace_back(origin[static_cast<std::size_t>(v)], piece[static_cast<std::size_t>(v)]);
  std::vector<std::pair<Index, Index>> sorted = keys;
  std::sort(sorted.begin(), sorted.end());
  const Points before = mesh.vertices;
  Points sums = Points::Zero(3, mesh.vertex_count());
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(mesh.vertex_count());
  for (const Eigen::Vector3i face : mesh.faces.colwise())
    for (int k = 0; k < 3; ++k) {
      sums.col(face[k]) += before.col(face[(k + 1) % 3]) + before.col(face[(k + 2) % 3]);
      counts[face[k]] += 2;
    }
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const auto [first, last] = std::equal_range(sorted.begin(), sorted.end(), keys[static_cast<std::size_t>(v)]);
    if (last - first > 1 && counts[v] > 0) mesh.vertices.col(v) += drawn_in * (sums.col(v) / counts[v] - before.col(v));
  }
}

}  // namespace

TriangleMesh separate_sheets(const TriangleMesh& mesh) {
  DisjointSets corners(3 * mesh.face_count());
  for_each_edge(sorted_half_edges(mesh.faces), [&](std::span<const HalfEdge> sides) {
    for (const auto& [one, other] : neighbors_at(mesh, sides))
      for (const Index vertex : {sides[0].low, sides[0].high})
        corners.join(corner_at(mesh, one, vertex), corner_at(mesh, other, vertex));
  });
  TriangleMesh result{Points(3, 3 * mesh.face_count()), mesh.faces};
  std::vector<Index> number(static_cast<std::size_t>(3 * mesh.face_count()), -1), origin;
  for (Index corner = 0; corner < 3 * mesh.face_count(); ++corner) {
    Index& vertex = number[static_cast<std::size_t>(corners.find(corner))];
    const Index old = mesh.faces(corner % 3, corner / 3);
    if (vertex < 0) {
      vertex = static_cast<Index>(origin.size());
      result.vertices.col(vertex) = mesh.vertices.col(old);
      origin.push_back(old);
    }
    result.faces(corner % 3, corner / 3) = vertex;
  }
  result.vertices.conservativeResize(3, static_cast<Index>(origin.size()));
  draw_apart(result, origin);
  return result;
}

}  // namespace gracilis
