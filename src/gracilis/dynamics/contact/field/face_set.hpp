#pragma once

#include <gracilis/dynamics/constraints/color_order.hpp>

#include <array>
#include <vector>

namespace gracilis {

/// Faces so large that something can poke through between their edges.
struct FaceSet {
  std::array<std::vector<Index>, 3> particles;
  std::vector<ColorRange> colors;  ///< faces of one color share no particle

  Index count() const { return static_cast<Index>(particles[0].size()); }  ///< of faces
};

/// Those faces, over `particle_count` particles, in the order of their colors.
FaceSet build_face_set(const Eigen::Matrix3Xi& faces, Index particle_count);

}  // namespace gracilis
