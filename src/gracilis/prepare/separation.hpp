#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/prepare/time_limit.hpp>

#include <optional>
#include <vector>

namespace gracilis {

struct SeparationSettings {
  Real muscle_gap = 0.0003;  ///< m, between two muscles
  Real bone_gap = 0.0003;    ///< m, between a muscle and a bone
  Real tolerance = 0.00005;  ///< m by which a gap may be missed
  int smooth_rounds = 24;    ///< rounds in which the displacement is smoothed
  int rounds = 120;          ///< rounds in all, at most
  Real farthest = 2;  ///< no vertex moves by more than this many times what its muscle's worst gap lacks at first
  std::vector<Real> at_most = {};  ///< m for each muscle, instead of `farthest`; none: that
  /// For each muscle, the muscles that it gives way to: none of them, so that it stays as a bone does, or, not given,
  /// all and bones. Empty: that for each.
  std::vector<std::optional<std::vector<Index>>> apart_from = {};
};

struct SeparationResult {
  int rounds = 0;            ///< that were needed
  std::vector<Real> lacked;  ///< m by which each muscle's worst gap was missed before
  std::vector<Real> moved;   ///< m by which its vertices were moved, at most
  Real shortfall = 0;        ///< m by which the worst gap is still missed
  Index missed = 0;          ///< samples that miss their gap by more than the tolerance
};

/// Moves vertices of `muscles` until all of them stay `muscle_gap` apart from each other and `bone_gap` outside of the
/// bones, which do not move; of an overlap between two muscles each gives way half, or one wholly where the other
/// does not give way to it. In each round every vertex, middle of an edge and middle of a face looks for the nearest
/// point of every other surface as it is now, and is pushed along the line between the two; then the displacement so
/// far is smoothed along the surface, so that the surroundings go along and no spike arises; the last rounds only push.
/// No vertex goes farther than `farthest` times the worst overlap of its muscle, gap included, so that nothing diverges
/// where surfaces cannot be pulled apart. Faces keep their order. Where nothing is too close nothing moves.
/// Preconditions: muscles closed and oriented outwards; bones have at least one face.
SeparationResult separate(std::vector<TriangleMesh>& muscles, const std::vector<TriangleMesh>& bones,
                          const SeparationSettings& settings, const TimeLimit& limit = TimeLimit());

}  // namespace gracilis
