#include <gracilis/geometry/opposite_vertices.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/triangle_tree.hpp>
#include <gracilis/geometry/vertex_normals.hpp>

#include <limits>

namespace gracilis {

/// Lines begin this far inside, over the diagonal of the surface's box, so that they do not meet where they begin.
static constexpr Real inset_share = 1e-6;

std::vector<Index> opposite_vertices(const TriangleMesh& surface) {
  const Points& vertices = surface.vertices;
  const Points normals = vertex_normals(vertices, surface.faces);
  const Real size = (vertices.rowwise().maxCoeff() - vertices.rowwise().minCoeff()).norm();
  const TriangleTree hits(surface);
  std::vector<Index> opposite(static_cast<std::size_t>(vertices.cols()), -1);
  parallel_for(static_cast<Index>(vertices.cols()), 64, [&](Index begin, Index end) {
    for (Index v = begin; v < end; ++v) {
      const Vec3 place = vertices.col(v), inwards = -normals.col(v);
      if (inwards.isZero(0)) continue;
      const auto hit = hits.first(place + inset_share * size * inwards, place + size * inwards);
      if (!hit) continue;
      Real nearest = std::numeric_limits<Real>::infinity();
      for (const Index corner : surface.faces.col(hit->face)) {
        const Real distance = (vertices.col(corner) - hit->place).squaredNorm();
        if (corner != v && distance < nearest) nearest = distance, opposite[static_cast<std::size_t>(v)] = corner;
      }
    }
  });
  return opposite;
}

}  // namespace gracilis
