#pragma once

#include <gracilis/core/types.hpp>

namespace gracilis {

/// A triangle surface; faces index columns of `vertices`, counter-clockwise seen from outside.
struct TriangleMesh {
  Points vertices;         ///< 3 × n, m
  Eigen::Matrix3Xi faces;  ///< 3 × m

  Index vertex_count() const { return static_cast<Index>(vertices.cols()); }  ///< used by faces or not
  Index face_count() const { return static_cast<Index>(faces.cols()); }       ///< triangles
};

}  // namespace gracilis
