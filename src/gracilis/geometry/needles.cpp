#include <gracilis/geometry/needles.hpp>

#include <gracilis/geometry/angle_between.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/topology.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace gracilis {

namespace {

/// From which length on an edge is a needle's, and which share of edges may be before a surface is made of them. In
/// even edges.
constexpr Real needle_length = 3, tolerated_share = 0.01;
/// Longest edge that is left, below that of needles so that what was divided never is again; and how far a flip may
/// move the surface. In even edges.
constexpr Real longest_left = 2.5, flip_distance = 0.04;
/// Flips end by themselves where a surface is flat; on a curved one this many rounds are enough.
constexpr int flip_rounds = 30;
/// Two or three are enough where needles have any width.
constexpr int dividing_rounds = 10;
/// A triangle's normal after a flip must not turn further from the two before than this, cosine.
constexpr Real least_cosine = 0.1;

Real length_of(const TriangleMesh& mesh, const MeshEdge& edge) {
  return (mesh.vertices.col(edge.a) - mesh.vertices.col(edge.b)).norm();
}

/// Whether the two triangles at an edge are better and nearly the same surface with the other diagonal.
bool should_flip(const TriangleMesh& mesh, const MeshEdge& edge, Real most_distance) {
  constexpr Real rounding = 1e-6;
  const Vec3 a = mesh.vertices.col(edge.a), b = mesh.vertices.col(edge.b), left = mesh.vertices.col(edge.left_apex),
             right = mesh.vertices.col(edge.right_apex);
  if (corner_angle(left, a, b) + corner_angle(right, a, b) <= pi + rounding) return false;
  const Vec3 across = (b - a).cross(right - left).stableNormalized();
  if (std::abs(across.dot(left - a)) > most_distance) return false;
  const Vec3 normal = ((b - a).cross(left - a) + (a - b).cross(right - b)).stableNormalized();
  const auto keeps_side = [&](const Vec3& area) { return area.dot(normal) > least_cosine * area.norm(); };
  return keeps_side((b - right).cross(left - right)) && keeps_side((a - left).cross(right - left));
}

/// Flips what should be, no two edges of one triangle at once. Returns whether there was anything.
bool flip_once(TriangleMesh& mesh, Real most_distance) {
  const std::vector<MeshEdge> edges = build_topology(mesh.faces, mesh.vertex_count()).edges;
  std::set<std::pair<Index, Index>> taken;
  for (const MeshEdge& edge : edges) taken.emplace(edge.a, edge.b);
  std::vector<char> changed(static_cast<std::size_t>(mesh.face_count()), 0);
  bool any = false;
  for (const MeshEdge& edge : edges) {
    char &left = changed[static_cast<std::size_t>(edge.left)], &right = changed[static_cast<std::size_t>(edge.right)];
    const auto diagonal = std::minmax(edge.left_apex, edge.right_apex);
    if (left || right || edge.left_apex == edge.right_apex || taken.contains(diagonal)) continue;
    if (!should_flip(mesh, edge, most_distance)) continue;
    mesh.faces.col(edge.left) << edge.right_apex, edge.b, edge.left_apex;
    mesh.faces.col(edge.right) << edge.left_apex, edge.a, edge.right_apex;
    taken.insert(diagonal);
    left = right = 1;
    any = true;
  }
  return any;
}

void flip(TriangleMesh& mesh, Real most_distance) {
  for (int round = 0; round < flip_rounds && flip_once(mesh, most_distance); ++round) {
  }
}

/// Halves edges that are too long, the longest first, no two of one triangle at once. Returns whether there were any.
bool halve_once(DividedNeedles& divided, Real most_length) {
  TriangleMesh& mesh = divided.mesh;
  const std::vector<MeshEdge> edges = build_topology(mesh.faces, mesh.vertex_count()).edges;
  std::vector<std::pair<Real, std::size_t>> too_long;
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (const Real length = length_of(mesh, edges[e]); length > most_length) too_long.emplace_back(-length, e);
  if (too_long.empty()) return false;
  std::sort(too_long.begin(), too_long.end());
  std::vector<char> changed(static_cast<std::size_t>(mesh.face_count()), 0);
  std::vector<Vec3> middles;
  std::vector<Eigen::Vector3i> halves;
  for (const auto& [length, e] : too_long) {
    const MeshEdge& edge = edges[e];
    char &left = changed[static_cast<std::size_t>(edge.left)], &right = changed[static_cast<std::size_t>(edge.right)];
    if (left || right) continue;
    left = right = 1;
    const Index middle = mesh.vertex_count() + static_cast<Index>(middles.size());
    middles.emplace_back((mesh.vertices.col(edge.a) + mesh.vertices.col(edge.b)) / 2);
    divided.ends.push_back({edge.a, edge.b});
    for (const Index face : {edge.left, edge.right}) {
      Eigen::Vector3i half = mesh.faces.col(face);
      for (Index& corner : half)
        if (corner == edge.b) corner = middle;
      halves.push_back(half);
      for (Index& corner : mesh.faces.col(face))
        if (corner == edge.a) corner = middle;
    }
  }
  const Index vertices = mesh.vertex_count(), faces = mesh.face_count();
  mesh.vertices.conservativeResize(3, vertices + static_cast<Index>(middles.size()));
  for (std::size_t i = 0; i < middles.size(); ++i) mesh.vertices.col(vertices + static_cast<Index>(i)) = middles[i];
  mesh.faces.conservativeResize(3, faces + static_cast<Index>(halves.size()));
  for (std::size_t i = 0; i < halves.size(); ++i) mesh.faces.col(faces + static_cast<Index>(i)) = halves[i];
  return true;
}

}  // namespace

Real even_edge(const TriangleMesh& mesh) {
  Real twice_the_area = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) twice_the_area += area_vector(mesh.vertices, mesh.faces.col(f)).norm();
  return mesh.face_count() > 0 ? std::sqrt(2 * twice_the_area / (std::sqrt(3.0) * mesh.face_count())) : 0;
}

bool has_needles(const TriangleMesh& mesh) {
  const std::vector<MeshEdge> edges = build_topology(mesh.faces, mesh.vertex_count()).edges;
  const Real most_length = needle_length * even_edge(mesh);
  const auto count = std::count_if(edges.begin(), edges.end(),
                                   [&](const MeshEdge& edge) { return length_of(mesh, edge) > most_length; });
  return static_cast<Real>(count) > tolerated_share * static_cast<Real>(edges.size());
}

DividedNeedles divide_needles(const TriangleMesh& mesh) {
  DividedNeedles divided{mesh, {}};
  if (!(even_edge(mesh) > 0)) return divided;
  // More triangles make the even edge shorter, so that what was just short enough may be too long then.
  for (int round = 0; round < dividing_rounds && (round == 0 || has_needles(divided.mesh)); ++round) {
    const Real even = even_edge(divided.mesh);
    do flip(divided.mesh, flip_distance * even);
    while (halve_once(divided, longest_left * even));
  }
  return divided;
}

}  // namespace gracilis
