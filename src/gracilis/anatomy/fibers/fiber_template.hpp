#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/scene/fiber_settings.hpp>

#include <vector>

namespace gracilis {

/// `count` points spread evenly over the unit square: Roberts' additive sequence, which covers it as well for any count
/// as for any other, shifted so that no point lies on its sides.
std::vector<Eigen::Vector2d> spread_over_square(Index count);

/// Where the template's fiber that passes through `start` half way (for the fan: that begins there) is at the share `s`
/// of its way from origin to insertion. `slenderness` is the muscle's length over its width along the square's first
/// axis, which turns angles in the muscle into slopes in the cube. Stays within the unit square: fibers that meet its
/// side go on along it.
Eigen::Vector2d template_point(const FiberSettings& settings, const Eigen::Vector2d& start, Real s, Real slenderness);

}  // namespace gracilis
