#pragma once

#include <gracilis/scene/scene.hpp>

#include <vector>

namespace gracilis {

/// Changes the coordinates (rad, m) of the joint that moves a bone so that a point of it (at rest, m) is, seen along
/// `looking` (unit), nearest to `target`, within their ranges. False where no joint moves the bone itself.
bool pull_bone(const Scene& scene, std::size_t bone, const Vec3& point, const Vec3& target, const Vec3& looking,
               std::vector<Real>& coordinates);

}  // namespace gracilis
