#pragma once

#include <gracilis/opensim/reader/model.hpp>

namespace gracilis::opensim {

/// The curves that a muscle is made of (curves_of): Thelen (2003), Millard et al. (2013), De Groote et al. (2016), with
/// parameters as OpenSim reads and formulas as its sources have them. Forces are over the largest isometric force.

/// Of the fiber's length over its optimal length.
Real force_length_factor(const Muscle& muscle, Real length);
/// Of the fiber's speed over the largest one, longer is positive. Thelen's depends on activation.
Real force_velocity_factor(const Muscle& muscle, Real speed, Real activation = 1);
/// Passive force of the fiber's length over its optimal length.
Real passive_factor(const Muscle& muscle, Real length);
/// Force of a tendon's length over its slack length.
Real tendon_factor(const Muscle& muscle, Real length);

/// How fibers stand: as wide as at the optimal length, so steeper the shorter they are.
struct FiberGeometry {
  Real height = 0;    ///< m, of all fibers
  Real shortest = 0;  ///< m
  /// By the muscle's optimal fiber and its pennation there.
  explicit FiberGeometry(const Muscle& muscle);
  /// The fiber's length (m) along the tendon's line.
  Real along(Real fiber) const;
  Real cosine(Real fiber) const { return along(fiber) / fiber; }  ///< of the pennation of fibers so long (m)
};

}  // namespace gracilis::opensim
