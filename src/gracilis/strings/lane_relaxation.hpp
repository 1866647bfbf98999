#pragma once

#include <gracilis/strings/lane_places.hpp>
#include <gracilis/strings/muscle_strings.hpp>

#include <vector>

namespace gracilis::strings {

/// Moves of less than this are rounding of single precision and are not made, m.
inline constexpr float least_lane_move = 2e-7f;

/// Gauss-Newton steps as `NodeForces` and `StringSystem` have them, in single precision and a string per lane. Returns
/// how far a node of each string moved last, m.
std::vector<float> relax_lanes(const MuscleStrings& muscle, const BoneDistances& bones,
                               const std::vector<RigidTransform>& bodies, const Relaxation& relaxation,
                               LanePlaces& places);

}  // namespace gracilis::strings
