#pragma once

#include <gracilis/geometry/topology.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <vector>

namespace gracilis {

/// How much a surface's edges are stretched around each vertex.
class VertexStretch {
 public:
  /// A surface at rest, m.
  explicit VertexStretch(const TriangleMesh& rest);
  /// Per vertex the lengths of its edges together over those at rest; 1 where there is no edge. Precondition: as many
  /// points as at rest.
  std::vector<Real> of(const Points& points) const;

 private:
  std::vector<MeshEdge> edges_;
  std::vector<Real> rest_;  ///< m, per vertex
};

}  // namespace gracilis
