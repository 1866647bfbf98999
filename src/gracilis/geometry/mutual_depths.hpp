#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <vector>

namespace gracilis {

/// A vertex of one surface that lies inside another.
struct DepthInOther {
  Index surface = 0, vertex = 0;
  Index other = 0;  ///< the surface that it lies in
  Real depth = 0;   ///< m, to the nearest point of the other surface
};

/// What of a surface stays as it deforms.
struct ConnectedSurface {
  Eigen::Matrix3Xi faces;
  std::vector<MeshEdge> edges;
};

/// Finds how deep several surfaces lie in each other, frame after frame as they deform. The ends of an edge that does
/// not meet the other surface are on the same side of it, so of what hangs together by such edges three vertices are
/// asked where they are, each by the crossings of a ray, and most win. Depths are exact (NearestTriangle); an edge
/// longer by 1e-3 at both ends must not meet the other surface, either.
class MutualDepths {
 public:
  /// Keeps what does not change, faces and edges. Preconditions: at least one surface; each closed, oriented outwards.
  explicit MutualDepths(const std::vector<TriangleMesh>& surfaces);

  /// By surface, other, vertex. `points`: of each surface its vertices (3 × n, m), finite.
  std::vector<DepthInOther> find(const std::vector<Points>& points) const;

 private:
  std::vector<ConnectedSurface> surfaces_;
};

}  // namespace gracilis
