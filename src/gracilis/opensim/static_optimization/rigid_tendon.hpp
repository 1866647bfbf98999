#pragma once

#include <gracilis/opensim/reader/model.hpp>

namespace gracilis::opensim {

/// The force (N) along its tendon of a fully active muscle whose tendon keeps its slack length: maximum isometric
/// force, times the factors of fiber length and of fiber velocity, times the cosine of the pennation angle, without
/// passive force. The fibers' distance from the tendon's line stays what it is at the optimal length. Curves: Thelen
/// (2003) for Thelen2003Muscle, De Groote et al. (2016) for all others. `length` (m) and `speed` (m/s, longer is
/// positive) are the path's. Zero where the path is shorter than the slack tendon, or the fibers stand too steep.
Real rigid_tendon_force(const Muscle& muscle, Real length, Real speed);

/// The factors alone: of the fiber's length over its optimal length, and of its speed over the maximum one.
Real force_length_factor(const Muscle& muscle, Real length);
Real force_velocity_factor(const Muscle& muscle, Real speed);

}  // namespace gracilis::opensim
