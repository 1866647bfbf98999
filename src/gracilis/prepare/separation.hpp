#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <vector>

namespace gracilis {

struct SeparationSettings {
  Real muscle_gap = 0.0003;  ///< m, between two muscles
  Real bone_gap = 0.0003;    ///< m, between a muscle and a bone
  Real tolerance = 0.00005;  ///< m by which a gap may be missed
  int smooth_rounds = 24;    ///< rounds in which the displacement is smoothed
  int rounds = 120;          ///< rounds in all, at most
};

struct SeparationResult {
  int rounds = 0;      ///< that were needed
  Real shortfall = 0;  ///< m by which the worst gap is still missed
  Index missed = 0;    ///< samples that miss their gap by more than the tolerance
};

/// Moves vertices of `muscles` until all of them stay `muscle_gap` apart from each other and `bone_gap` outside of the
/// bones, which do not move; of an overlap between two muscles each gives way half. In each round every vertex, middle
/// of an edge and middle of a face looks for the nearest point of every other surface as it is now, and is pushed along
/// the line between the two; then the displacement so far is smoothed along the surface, so that the surroundings go
/// along and no spike arises; the last rounds only push. Faces keep their order. Where nothing is too close nothing
/// moves. Preconditions: muscles closed and oriented outwards; bones have at least one face.
SeparationResult separate(std::vector<TriangleMesh>& muscles, const std::vector<TriangleMesh>& bones,
                          const SeparationSettings& settings);

}  // namespace gracilis
