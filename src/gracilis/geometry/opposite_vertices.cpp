#include <gracilis/geometry/opposite_vertices.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/segment_hits.hpp>

#include <limits>

namespace gracilis {

/// Lines begin this far inside, over the diagonal of the surface's box, so that they do not meet where they begin.
static constexpr Real inset_share = 1e-6;

/// Unit, outward, weighted by area; zero where triangles cancel.
static Points vertex_normals(const TriangleMesh& surface) {
  Points normals = Points::Zero(3, surface.vertices.cols());
  for (Index face = 0; face < surface.face_count(); ++face)
    for (const Index corner : surface.faces.col(face))
      normals.col(corner) += area_vector(surface.vertices, surface.faces.col(face));
  for (Index v = 0; v < normals.cols(); ++v)
    if (const Real length = normals.col(v).norm(); length > 0) normals.col(v) /= length;
  return normals;
}

std::vector<Index> opposite_vertices(const TriangleMesh& surface) {
  const Points& vertices = surface.vertices;
  const Points normals = vertex_normals(surface);
  const Real size = (vertices.rowwise().maxCoeff() - vertices.rowwise().minCoeff()).norm();
  const SegmentHits hits(surface);
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
