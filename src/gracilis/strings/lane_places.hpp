#pragma once

#include <gracilis/strings/string_lanes.hpp>

#include <array>
#include <vector>

namespace gracilis::strings {

/// Nodes in the order of StringLanes; world, m.
using LanePlaces = std::array<std::vector<double>, 3>;

/// Of nodes in the order of MuscleStrings; lanes that are left over repeat the last string.
LanePlaces lane_places(const StringLanes& lanes, const Points& places);
/// Back again.
Points places_of(const StringLanes& lanes, const LanePlaces& places);

/// Where bodies carry the nodes that another pose left; held ones go with their bodies.
void carry_lanes(const StringLanes& lanes, const std::vector<RigidTransform>& before,
                 const std::vector<RigidTransform>& now, LanePlaces& places);

}  // namespace gracilis::strings
