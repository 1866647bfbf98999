#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <functional>

namespace gracilis {

/// Some of a surface's vertices with their normals and what of its area belongs to each.
struct SurfaceSamples {
  Points points, normals;  ///< 3 × n; normals are unit
  Eigen::VectorXd areas;   ///< m²

  Index count() const { return static_cast<Index>(points.cols()); }  ///< of samples
  /// Those that `keep` says, by their number.
  SurfaceSamples kept(const std::function<bool(Index)>& keep) const;
};

/// All vertices that have a normal.
SurfaceSamples surface_samples(const TriangleMesh& mesh);

}  // namespace gracilis
