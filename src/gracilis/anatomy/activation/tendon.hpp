#pragma once

#include <gracilis/geometry/topology.hpp>
#include <gracilis/scene/scene.hpp>

#include <vector>

namespace gracilis {

/// How much of a belly each vertex of a surface is: 0 on `attached` vertices, 1 `tendon_length` (m, along the surface)
/// away from them or, on a muscle too short for that, half as far as its farthest vertex; smooth in between. 1
/// everywhere when nothing is attached or the length is 0.
std::vector<Real> belly_shares(const Points& vertices, const MeshTopology& topology, const std::vector<Index>& attached,
                               Real tendon_length);

/// The same for a muscle of a scene.
std::vector<Real> belly_shares(const Muscle& muscle, Real tendon_length);

}  // namespace gracilis
