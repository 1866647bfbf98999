#include <gracilis/geometry/mutual_depths.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/disjoint_sets.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/nearest_triangle.hpp>
#include <gracilis/geometry/triangle_tree.hpp>

#include <algorithm>
#include <array>
#include <compare>
#include <numeric>
#include <optional>
#include <span>

namespace gracilis {

namespace {

/// An edge of a surface that meets a face of another.
struct Meeting {
  Index other = 0, edge = 0;

  auto operator<=>(const Meeting&) const = default;
};

/// All surfaces in one frame.
struct SurfacesNow {
  const TriangleMesh& mesh;
  const std::vector<Index>& surface_of;  ///< per face
  const TriangleTree& triangles;
  std::vector<Eigen::AlignedBox3d> boxes;  ///< around each surface
  Real size = 0;                           ///< m, of the box around all
};

struct EdgeQuestion {
  const SurfacesNow& now;
  Index own = 0, edge = 0;
  std::vector<Meeting>& found;
};

void note_meeting(Index face, void* query) {
  const auto& question = *static_cast<const EdgeQuestion*>(query);
  const Index other = question.now.surface_of[static_cast<std::size_t>(face)];
  if (other != question.own) question.found.push_back({other, question.edge});
}

/// Which edges of a surface meet which others, ascending, each once.
std::vector<Meeting> meetings(const SurfacesNow& now, Index number, const NumberedSurface& surface) {
  constexpr Real beyond_ends = 1e-3;  // of the edge: an end that lies on the other surface is on neither side of it
  std::vector<Meeting> found = collect_in_order<Meeting>(
      static_cast<Index>(surface.edges.size()), 1024, [&](Index begin, Index end, auto& part) {
        for (Index e = begin; e < end; ++e) {
          const MeshEdge& edge = surface.edges[static_cast<std::size_t>(e)];
          const Vec3 a = now.mesh.vertices.col(surface.first_vertex + edge.a),
                     b = now.mesh.vertices.col(surface.first_vertex + edge.b);
          EdgeQuestion question{now, number, e, part};
          now.triangles.all(a - beyond_ends * (b - a), b + beyond_ends * (b - a), note_meeting, &question);
        }
      });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

struct RayQuestion {
  const SurfacesNow& now;
  Index other = 0;
  Vec3 direction;
  int left = 0;  ///< how often the ray leaves the other surface, less how often it enters it
};

void count_crossing(Index face, void* query) {
  auto& question = *static_cast<RayQuestion*>(query);
  const SurfacesNow& now = question.now;
  if (now.surface_of[static_cast<std::size_t>(face)] != question.other) return;
  question.left += area_vector(now.mesh.vertices, now.mesh.faces.col(face)).dot(question.direction) > 0 ? 1 : -1;
}

/// Whether vertices on one side of a surface are inside it.
bool are_inside(const SurfacesNow& now, Index first_vertex, std::span<const Index> vertices, Index other) {
  static const std::array<Vec3, 3> directions = {
      Vec3(0.62, 0.35, 0.70).normalized(), Vec3(-0.71, 0.59, 0.38).normalized(), Vec3(0.17, -0.83, 0.53).normalized()};
  std::size_t inside = 0;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Vec3 p = now.mesh.vertices.col(first_vertex + vertices[i * vertices.size() / directions.size()]);
    RayQuestion question{now, other, directions[i], 0};
    now.triangles.all(p, p + now.size * directions[i], count_crossing, &question);
    inside += question.left > 0;
  }
  return 2 * inside > directions.size();
}

/// What hangs together by edges that are not in `cut` (ascending): per vertex the one that stands for its part.
std::vector<Index> parts_without(const NumberedSurface& surface, std::span<const Meeting> cut) {
  DisjointSets parts(surface.vertex_count);
  auto next = cut.begin();
  for (Index e = 0; e < static_cast<Index>(surface.edges.size()); ++e) {
    const MeshEdge& edge = surface.edges[static_cast<std::size_t>(e)];
    if (next != cut.end() && next->edge == e)
      ++next;
    else
      parts.join(edge.a, edge.b);
  }
  std::vector<Index> part_of;
  for (Index v = 0; v < surface.vertex_count; ++v) part_of.push_back(parts.find(v));
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

/// What of one surface lies in which others, by other and vertex, without depths.
std::vector<DepthInOther> inside_others(const SurfacesNow& now, Index number, const NumberedSurface& surface) {
  const std::vector<Meeting> found = meetings(now, number, surface);
  const auto box = [&](Index s) { return now.boxes[static_cast<std::size_t>(s)]; };
  std::vector<DepthInOther> inside;
  auto begin = found.begin();
  for (Index other = 0; other < static_cast<Index>(now.boxes.size()); ++other) {
    const auto end = std::find_if(begin, found.end(), [&](const Meeting& each) { return each.other != other; });
    const std::span<const Meeting> cut(begin, end);
    begin = end;
    // What meets nothing is inside whole or not at all.
    if (other == number || (cut.empty() && !box(other).contains(box(number)))) continue;
    std::vector<Index> vertices;
    for_each_part(parts_without(surface, cut), [&](std::span<const Index> part) {
      if (are_inside(now, surface.first_vertex, part, other)) vertices.insert(vertices.end(), part.begin(), part.end());
    });
    std::sort(vertices.begin(), vertices.end());
    for (const Index v : vertices) inside.push_back({number, v, other, 0});
  }
  return inside;
}

/// Adds their depths.
void measure(const std::vector<NumberedSurface>& surfaces, const std::vector<Points>& points,
             std::vector<DepthInOther>& inside) {
  std::vector<char> is_asked(surfaces.size(), 0);
  for (const DepthInOther& each : inside) is_asked[static_cast<std::size_t>(each.other)] = 1;
  std::vector<std::optional<NearestTriangle>> nearest(surfaces.size());
  parallel_for_each(surfaces.size(), [&](std::size_t s) {
    if (is_asked[s]) nearest[s].emplace(TriangleMesh{points[s], surfaces[s].faces});
  });
  parallel_for(static_cast<Index>(inside.size()), 256, [&](Index begin, Index end) {
    Index last = -1, face = 0;
    for (Index i = begin; i < end; ++i) {
      DepthInOther& each = inside[static_cast<std::size_t>(i)];
      if (each.other != last) last = each.other, face = 0;
      const Vec3 p = points[static_cast<std::size_t>(each.surface)].col(each.vertex);
      const NearestPoint found = nearest[static_cast<std::size_t>(each.other)]->query_from(face, p);
      face = found.face, each.depth = found.distance;
    }
  });
}

}  // namespace

MutualDepths::MutualDepths(const std::vector<TriangleMesh>& surfaces) {
  Index vertices = 0, faces = 0;
  for (const TriangleMesh& mesh : surfaces) faces += mesh.face_count();
  all_faces_.resize(3, faces);
  for (const TriangleMesh& mesh : surfaces) {
    all_faces_.middleCols(static_cast<Index>(surface_of_.size()), mesh.face_count()) = mesh.faces.array() + vertices;
    surface_of_.insert(surface_of_.end(), static_cast<std::size_t>(mesh.face_count()),
                       static_cast<Index>(surfaces_.size()));
    surfaces_.push_back(
        {mesh.faces, build_topology(mesh.faces, mesh.vertex_count()).edges, mesh.vertex_count(), vertices});
    vertices += mesh.vertex_count();
  }
}

std::vector<DepthInOther> MutualDepths::find(const std::vector<Points>& points) const {
  TriangleMesh all{Points(3, surfaces_.back().first_vertex + surfaces_.back().vertex_count), all_faces_};
  std::vector<Eigen::AlignedBox3d> boxes;
  for (std::size_t s = 0; s < surfaces_.size(); ++s) {
    all.vertices.middleCols(surfaces_[s].first_vertex, surfaces_[s].vertex_count) = points[s];
    boxes.push_back(bounding_box(points[s]));
  }
  const TriangleTree triangles(all);
  const SurfacesNow now{all, surface_of_, triangles, boxes, bounding_box(all.vertices).diagonal().norm()};
  std::vector<std::vector<DepthInOther>> of_surfaces(surfaces_.size());
  parallel_for_each(surfaces_.size(),
                    [&](std::size_t s) { of_surfaces[s] = inside_others(now, static_cast<Index>(s), surfaces_[s]); });
  std::vector<DepthInOther> inside;
  for (const std::vector<DepthInOther>& each : of_surfaces) inside.insert(inside.end(), each.begin(), each.end());
  measure(surfaces_, points, inside);
  return inside;
}

}  // namespace gracilis
