#include <gracilis/anatomy/overlap/rest_overlap.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/signed_distance.hpp>
#include <gracilis/scene/attached_vertices.hpp>

#include <Eigen/Geometry>

#include <iterator>
#include <optional>
#include <set>
#include <utility>

namespace gracilis {

namespace {

/// Nearer to a surface (m) a vertex lies on it and not inside, where rounding alone would say which way is out.
constexpr Real on_surface = 1e-9;

/// What a surface answers about points.
struct Solid {
  explicit Solid(const TriangleMesh& mesh) : distance(mesh), box(bounding_box(mesh.vertices)) {}

  SignedDistance distance;
  Eigen::AlignedBox3d box;
};

/// `left_out`: per vertex; empty: none is.
InsideVertices vertices_inside(const TriangleMesh& mesh, const Solid& other, const std::vector<char>& left_out = {}) {
  InsideVertices inside;
  std::vector<Vec3> outward;
  Index face = -1;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 p = mesh.vertices.col(v);
    if (!other.box.contains(p) || (!left_out.empty() && left_out[static_cast<std::size_t>(v)])) continue;
    const SignedDistance::Answer answer = face < 0 ? other.distance.query(p) : other.distance.query_from(face, p);
    face = answer.nearest.face;
    if (!(answer.distance < -on_surface)) continue;
    inside.vertices.push_back(v);
    inside.depths.push_back(-answer.distance);
    outward.push_back((answer.nearest.point - p).stableNormalized());
  }
  inside.outward.resize(3, static_cast<Eigen::Index>(outward.size()));
  for (std::size_t i = 0; i < outward.size(); ++i) inside.outward.col(static_cast<Eigen::Index>(i)) = outward[i];
  return inside;
}

}  // namespace

std::vector<RestOverlap> rest_overlaps(const std::vector<TriangleMesh>& surfaces) {
  std::vector<std::optional<Solid>> solids(surfaces.size());
  parallel_for_each(surfaces.size(), [&](std::size_t i) { solids[i].emplace(surfaces[i]); });
  std::vector<RestOverlap> overlaps;
  for (std::size_t first = 0; first < surfaces.size(); ++first)
    for (std::size_t second = first + 1; second < surfaces.size(); ++second)
      if (solids[first]->box.intersects(solids[second]->box))
        overlaps.push_back({static_cast<Index>(first), static_cast<Index>(second), {}, {}});
  parallel_for_each(2 * overlaps.size(), [&](std::size_t i) {
    RestOverlap& overlap = overlaps[i / 2];
    const auto first = static_cast<std::size_t>(overlap.first), second = static_cast<std::size_t>(overlap.second);
    if (i % 2 == 0)
      overlap.of_first = vertices_inside(surfaces[first], *solids[second]);
    else
      overlap.of_second = vertices_inside(surfaces[second], *solids[first]);
  });
  std::erase_if(overlaps, [](const RestOverlap& overlap) {
    return overlap.of_first.vertices.empty() && overlap.of_second.vertices.empty();
  });
  return overlaps;
}

Real deepest_around(const std::vector<DepthAtRest>& overlapping, const Vec3& place) {
  Real deepest = 0;
  for (const DepthAtRest& each : overlapping)
    if (each.depth > deepest && (each.place - place).squaredNorm() < slide_reach * slide_reach) deepest = each.depth;
  return deepest;
}

DepthsAround depths_around(const RestOverlap& overlap, const RestSurface& first, const RestSurface& second) {
  std::vector<DepthAtRest> overlapping;
  const auto list = [&](const InsideVertices& inside, const RestSurface& surface) {
    for (std::size_t i = 0; i < inside.vertices.size(); ++i)
      if (surface.is_free[static_cast<std::size_t>(inside.vertices[i])])
        overlapping.push_back({surface.rest.col(inside.vertices[i]), inside.depths[i]});
  };
  list(overlap.of_first, first);
  list(overlap.of_second, second);
  if (overlapping.empty()) return {};
  const auto around = [&](const Points& places) {
    std::vector<float> depths(static_cast<std::size_t>(places.cols()));
    parallel_for(static_cast<Index>(places.cols()), 256, [&](Index begin, Index end) {
      for (Index v = begin; v < end; ++v)
        depths[static_cast<std::size_t>(v)] = static_cast<float>(deepest_around(overlapping, places.col(v)));
    });
    return depths;
  };
  return {around(first.rest), around(second.rest)};
}

std::vector<RestOverlap> rest_overlaps(const Scene& scene) {
  std::vector<TriangleMesh> surfaces;
  for (const Muscle& muscle : scene.muscles) surfaces.push_back(muscle.surface);
  return rest_overlaps(surfaces);
}

std::vector<BoneOverlap> rest_overlaps_with_bones(const Scene& scene) {
  std::vector<std::optional<Solid>> bones(scene.bones.size());
  parallel_for_each(bones.size(), [&](std::size_t b) { bones[b].emplace(scene.bones[b].surface); });
  std::vector<std::vector<BoneOverlap>> of_muscles(scene.muscles.size());
  parallel_for_each(of_muscles.size(), [&](std::size_t m) {
    const Muscle& muscle = scene.muscles[m];
    const std::vector<char> attached = attached_vertices(muscle);
    const Eigen::AlignedBox3d box = bounding_box(muscle.surface.vertices);
    for (std::size_t b = 0; b < bones.size(); ++b) {
      if (!bones[b]->box.intersects(box)) continue;
      BoneOverlap overlap{static_cast<Index>(m), static_cast<Index>(b),
                          vertices_inside(muscle.surface, *bones[b], attached)};
      if (!overlap.inside.vertices.empty()) of_muscles[m].push_back(std::move(overlap));
    }
  });
  std::vector<BoneOverlap> overlaps;
  for (std::vector<BoneOverlap>& each : of_muscles) std::move(each.begin(), each.end(), std::back_inserter(overlaps));
  return overlaps;
}

Index count_inside(const std::vector<RestOverlap>& overlaps) {
  std::set<std::pair<Index, Index>> inside;
  for (const RestOverlap& overlap : overlaps) {
    for (const Index v : overlap.of_first.vertices) inside.emplace(overlap.first, v);
    for (const Index v : overlap.of_second.vertices) inside.emplace(overlap.second, v);
  }
  return static_cast<Index>(inside.size());
}

}  // namespace gracilis
