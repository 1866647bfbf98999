#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

#include <vector>

namespace gracilis {

/// Points spread over a surface by its area, whatever its triangles, that can follow it when it deforms.
struct AreaSamples {
  std::vector<Index> faces;
  Points shares;  ///< barycentric, 3 × n

  Index count() const { return static_cast<Index>(faces.size()); }                ///< of samples
  Points points(const Points& vertices, const Eigen::Matrix3Xi& of_faces) const;  ///< where they are now, m: 3 × n
  /// Unit normals of the samples' triangles; zero where a triangle has none.
  Points normals(const Points& vertices, const Eigen::Matrix3Xi& of_faces) const;
};

/// The same for the same surface. Precondition: it has area.
AreaSamples area_samples(const TriangleMesh& mesh, Index count);

}  // namespace gracilis
