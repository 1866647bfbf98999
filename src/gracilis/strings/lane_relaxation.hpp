#pragma once

#include <gracilis/strings/muscle_strings.hpp>

#include <array>
#include <vector>

namespace gracilis::strings {

/// Moves of less than this are rounding of single precision and are not made, m.
inline constexpr float least_lane_move = 2e-7f;

/// Nodes in the order of StringLanes; world, m.
using LanePlaces = std::array<std::vector<double>, 3>;

LanePlaces lane_places(const StringLanes& lanes, const Points& places);
Points places_of(const StringLanes& lanes, const LanePlaces& places);

/// Where bodies carry the nodes that another pose left; held ones go with their bodies.
void carry_lanes(const StringLanes& lanes, const std::vector<RigidTransform>& before,
                 const std::vector<RigidTransform>& now, LanePlaces& places);

/// Gauss-Newton steps as `NodeForces` and `StringSystem` have them, in single precision and a string per lane. Returns
/// how far a node of each string moved last, m.
std::vector<float> relax_lanes(const MuscleStrings& muscle, const BoneDistances& bones,
                               const std::vector<RigidTransform>& bodies, const Relaxation& relaxation,
                               LanePlaces& places);

}  // namespace gracilis::strings
