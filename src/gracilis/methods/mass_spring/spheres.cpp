#include <gracilis/methods/mass_spring/spheres.hpp>

#include <gracilis/geometry/nearest_points.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/geometry/vertex_normals.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gracilis::mass_spring {

std::vector<Real> muscle_radii(const Points& particles, const std::vector<char>& on_boundary, const Points& vertices) {
  const auto count = static_cast<Index>(particles.cols());
  std::vector<Index> boundary;
  for (Index p = 0; p < count; ++p)
    if (on_boundary[static_cast<std::size_t>(p)]) boundary.push_back(p);
  std::vector<Real> radii(static_cast<std::size_t>(count), 0);
  if (boundary.empty()) return radii;
  Points places(3, static_cast<Index>(boundary.size()));
  for (std::size_t i = 0; i < boundary.size(); ++i) places.col(static_cast<Index>(i)) = particles.col(boundary[i]);
  const NearestPoints nearest(places);
  std::vector<Index> vertex_counts(static_cast<std::size_t>(count), 0);
  for (Index v = 0; v < static_cast<Index>(vertices.cols()); ++v) {
    const Index p = boundary[static_cast<std::size_t>(nearest.nearest(vertices.col(v)))];
    radii[static_cast<std::size_t>(p)] += (vertices.col(v) - particles.col(p)).norm();
    ++vertex_counts[static_cast<std::size_t>(p)];
  }
  for (std::size_t p = 0; p < radii.size(); ++p)
    if (vertex_counts[p] > 0) radii[p] /= vertex_counts[p];
  shrink_apart(particles, radii);
  return radii;
}

void shrink_apart(const Points& centers, std::vector<Real>& radii) {
  if (radii.empty()) return;
  std::vector<Index> order(radii.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
    return radii[static_cast<std::size_t>(a)] > radii[static_cast<std::size_t>(b)];
  });
  const NearestPoints nearest(centers);
  const Real largest = radii[static_cast<std::size_t>(order.front())];
  // Radii only shrink, so spheres that were brought apart stay apart.
  for (const Index a : order) {
    Real& own = radii[static_cast<std::size_t>(a)];
    if (!(own > 0)) continue;
    for (const Index b : nearest.within(centers.col(a), own + largest)) {
      Real& other = radii[static_cast<std::size_t>(b)];
      const Real distance = (centers.col(a) - centers.col(b)).norm();
      if (a == b || !(other > 0) || own + other <= distance) continue;
      Real &larger = own > other ? own : other, &smaller = own > other ? other : own;
      larger = std::max(distance - smaller, distance / 2);
      smaller = std::min(smaller, distance - larger);
    }
  }
}

namespace {

/// The vertices within so many edges of one, without itself.
std::vector<Index> around(const VertexStars& stars, Index vertex, int rings) {
  std::vector<Index> found = {vertex}, front = {vertex};
  for (int r = 0; r < rings; ++r) {
    std::vector<Index> next;
    for (const Index v : front) {
      const auto at = static_cast<std::size_t>(v);
      for (Index i = stars.offsets[at]; i < stars.offsets[at + 1]; ++i) {
        const Index other = stars.neighbors[static_cast<std::size_t>(i)];
        if (std::find(found.begin(), found.end(), other) != found.end()) continue;
        found.push_back(other);
        next.push_back(other);
      }
    }
    front = std::move(next);
  }
  found.erase(found.begin());
  return found;
}

}  // namespace

Spheres bone_spheres(const TriangleMesh& surface, int rings) {
  const VertexStars stars = build_topology(surface.faces, surface.vertex_count()).stars;
  const Points normals = vertex_normals(surface.vertices, surface.faces);
  std::vector<char> is_covered(static_cast<std::size_t>(surface.vertex_count()), 0);
  std::vector<Vec3> centers;
  Spheres spheres;
  for (Index v = 0; v < surface.vertex_count(); ++v) {
    if (is_covered[static_cast<std::size_t>(v)]) continue;
    const std::vector<Index> ring = around(stars, v, rings);
    Real farthest = 0;
    for (const Index other : ring) {
      is_covered[static_cast<std::size_t>(other)] = 1;
      farthest = std::max(farthest, (surface.vertices.col(other) - surface.vertices.col(v)).norm());
    }
    if (!(farthest > 0)) continue;
    centers.emplace_back(surface.vertices.col(v) - farthest * normals.col(v));
    spheres.radii.push_back(std::sqrt(2.0) * farthest);
  }
  spheres.centers.resize(3, static_cast<Index>(centers.size()));
  for (std::size_t i = 0; i < centers.size(); ++i) spheres.centers.col(static_cast<Index>(i)) = centers[i];
  return spheres;
}

}  // namespace gracilis::mass_spring
