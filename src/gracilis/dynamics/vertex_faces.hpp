#pragma once

#include <gracilis/core/types.hpp>

#include <span>
#include <vector>

namespace gracilis {

/// The faces around each particle, in ascending order.
struct VertexFaces {
  std::vector<Index> offsets;  ///< of each particle, and the end
  std::vector<Index> faces;
  Eigen::Matrix2Xi ends;  ///< for each of `faces`, its other two corners, counter-clockwise

  /// The faces at a particle.
  std::span<const Index> around(Index particle) const {
    const auto at = static_cast<std::size_t>(particle);
    return {faces.begin() + offsets[at], faces.begin() + offsets[at + 1]};
  }
};

/// Of a triangle list over `particle_count` particles.
VertexFaces build_vertex_faces(const Eigen::Matrix3Xi& faces, Index particle_count);

}  // namespace gracilis
