#include <gracilis/geometry/mutual_depths.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/disjoint_sets.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/nearest_triangle.hpp>

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <span>

namespace gracilis {

namespace {

/// A surface in one frame.
struct SurfaceNow {
  const ConnectedSurface& surface;
  const Points& points;
  Eigen::AlignedBox3d box;
  NearestTriangle triangles;
};

/// For each point the sides of the box that it lies beyond, a bit each: a segment whose ends share one misses the box
/// (Cohen and Sutherland).
std::vector<unsigned char> sides_beyond(const Points& points, const Eigen::AlignedBox3d& box) {
  std::vector<unsigned char> sides;
  sides.reserve(static_cast<std::size_t>(points.cols()));
  for (const auto p : points.colwise()) {
    int beyond = 0;
    for (int axis = 0; axis < 3; ++axis)
      beyond |= (p[axis] < box.min()[axis]) << axis | (p[axis] > box.max()[axis]) << (3 + axis);
    sides.push_back(static_cast<unsigned char>(beyond));
  }
  return sides;
}

/// Which edges of a surface meet the other, ascending.
std::vector<Index> meeting_edges(const SurfaceNow& own, const SurfaceNow& other) {
  constexpr Real beyond_ends = 1e-3;  // of the edge: an end that lies on the other surface is on neither side of it
  const Vec3 room = Vec3::Constant(beyond_ends * own.box.diagonal().norm());
  const std::vector<unsigned char> sides =
      sides_beyond(own.points, Eigen::AlignedBox3d(other.box.min() - room, other.box.max() + room));
  std::vector<Index> found;
  for (Index e = 0; e < static_cast<Index>(own.surface.edges.size()); ++e) {
    const MeshEdge& edge = own.surface.edges[static_cast<std::size_t>(e)];
    if ((sides[static_cast<std::size_t>(edge.a)] & sides[static_cast<std::size_t>(edge.b)]) != 0) continue;
    const Vec3 beyond = beyond_ends * (own.points.col(edge.b) - own.points.col(edge.a));
    if (other.triangles.triangles().cut(own.points.col(edge.a) - beyond, own.points.col(edge.b) + beyond))
      found.push_back(e);
  }
  return found;
}

struct RayQuestion {
  const SurfaceNow& other;
  Vec3 direction;
  int left = 0;  ///< how often the ray leaves the other surface, less how often it enters it
};

void count_crossing(Index face, void* query) {
  auto& question = *static_cast<RayQuestion*>(query);
  const Vec3 normal = area_vector(question.other.points, question.other.surface.faces.col(face));
  question.left += normal.dot(question.direction) > 0 ? 1 : -1;
}

/// Whether vertices on one side of the other surface are inside it.
bool are_inside(const Points& points, std::span<const Index> vertices, const SurfaceNow& other) {
  static const std::array<Vec3, 3> directions = {
      Vec3(0.62, 0.35, 0.70).normalized(), Vec3(-0.71, 0.59, 0.38).normalized(), Vec3(0.17, -0.83, 0.53).normalized()};
  std::size_t inside = 0;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Vec3 p = points.col(vertices[i * vertices.size() / directions.size()]);
    const Real far = (p - other.box.center()).norm() + other.box.diagonal().norm();
    RayQuestion question{other, directions[i], 0};
    other.triangles.triangles().all(p, p + far * directions[i], count_crossing, &question);
    inside += question.left > 0;
  }
  return 2 * inside > directions.size();
}

/// What hangs together by edges that are not in `cut` (ascending): per vertex the one that stands for its part.
std::vector<Index> parts_without(const ConnectedSurface& surface, Index vertex_count, const std::vector<Index>& cut) {
  DisjointSets parts(vertex_count);
  auto next = cut.begin();
  for (Index e = 0; e < static_cast<Index>(surface.edges.size()); ++e) {
    const MeshEdge& edge = surface.edges[static_cast<std::size_t>(e)];
    if (next != cut.end() && *next == e)
      ++next;
    else
      parts.join(edge.a, edge.b);
  }
  std::vector<Index> part_of;
  for (Index v = 0; v < vertex_count; ++v) part_of.push_back(parts.find(v));
  return part_of;
}

/// Calls act(vertices) for each part of a surface.
template <class Act>
void for_each_part(const std::vector<Index>& part_of, const Act& act) {
  std::vector<std::size_t> begins(part_of.size() + 1, 0);
  for (const Index v : part_of) ++begins[static_cast<std::size_t>(v) + 1];
  std::partial_sum(begins.begin(), begins.end(), begins.begin());
  std::vector<std::size_t> next = begins;
  std::vector<Index> vertices(part_of.size());
  for (std::size_t v = 0; v < part_of.size(); ++v)
    vertices[next[static_cast<std::size_t>(part_of[v])]++] = static_cast<Index>(v);
  for (std::size_t v = 0; v < part_of.size(); ++v)
    if (begins[v + 1] > begins[v]) act(std::span<const Index>(&vertices[begins[v]], begins[v + 1] - begins[v]));
}

/// Vertices of a surface that lie in the other, ascending.
std::vector<Index> vertices_inside(const SurfaceNow& own, const SurfaceNow& other) {
  std::vector<Index> inside;
  const std::vector<Index> cut = meeting_edges(own, other);
  // What meets nothing is inside whole or not at all.
  if (cut.empty() && !other.box.contains(own.box)) return inside;
  for_each_part(parts_without(own.surface, own.points.cols(), cut), [&](std::span<const Index> part) {
    if (are_inside(own.points, part, other)) inside.insert(inside.end(), part.begin(), part.end());
  });
  std::sort(inside.begin(), inside.end());
  return inside;
}

std::vector<SurfaceNow> surfaces_now(const std::vector<ConnectedSurface>& surfaces, const std::vector<Points>& points) {
  std::vector<std::optional<NearestTriangle>> triangles(surfaces.size());
  parallel_for_each(surfaces.size(), [&](std::size_t s) {
    triangles[s].emplace(TriangleMesh{points[s], surfaces[s].faces});
  });
  std::vector<SurfaceNow> now;
  for (std::size_t s = 0; s < surfaces.size(); ++s)
    now.push_back({surfaces[s], points[s], bounding_box(points[s]), std::move(*triangles[s])});
  return now;
}

}  // namespace

MutualDepths::MutualDepths(const std::vector<TriangleMesh>& surfaces) {
  for (const TriangleMesh& mesh : surfaces)
    surfaces_.push_back({mesh.faces, build_topology(mesh.faces, mesh.vertex_count()).edges});
}

std::vector<DepthInOther> MutualDepths::find(const std::vector<Points>& points) const {
  const std::vector<SurfaceNow> now = surfaces_now(surfaces_, points);
  std::vector<std::pair<std::size_t, std::size_t>> near;
  for (std::size_t own = 0; own < now.size(); ++own)
    for (std::size_t other = 0; other < now.size(); ++other)
      if (own != other && now[own].box.intersects(now[other].box)) near.emplace_back(own, other);
  std::vector<std::vector<DepthInOther>> of_pairs(near.size());
  parallel_for_each(near.size(), [&](std::size_t pair) {
    const auto [own, other] = near[pair];
    Index face = 0;
    for (const Index v : vertices_inside(now[own], now[other])) {
      const NearestPoint nearest = now[other].triangles.query_from(face, points[own].col(v));
      of_pairs[pair].push_back({static_cast<Index>(own), v, static_cast<Index>(other), nearest.distance});
      face = nearest.face;
    }
  });
  std::vector<DepthInOther> inside;
  for (const std::vector<DepthInOther>& each : of_pairs) inside.insert(inside.end(), each.begin(), each.end());
  return inside;
}

}  // namespace gracilis
