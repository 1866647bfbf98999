#pragma once

#include <gracilis/scene/scene.hpp>
#include <gracilis/scene/twist.hpp>

#include <span>
#include <vector>

namespace gracilis {

/// Whether a joint of the scene moves the body: that hangs on it, or on a body that does.
bool hangs_on(const Scene& scene, Index body, const Joint& joint);

/// How all bodies move with each coordinate, per rad (m for translations), where the coordinates have these values (in
/// the order of `coordinate_names`, which that of the result is, too): the derivative of `pose_at`. A rotation turns
/// all bodies beyond its joint about its axis, where the axes before it have taken that; a translation shifts them.
std::vector<std::vector<Twist>> joint_twists(const Scene& scene, std::span<const Real> coordinates);

}  // namespace gracilis
