#pragma once

#include <gracilis/geometry/surface_samples.hpp>

namespace gracilis {

/// An axis about which a surface slides along itself.
struct RevolutionFit {
  Vec3 center = Vec3::Zero();     ///< on the axis, nearest to the samples' middle
  Vec3 direction = Vec3::Zero();  ///< unit; zero: none was found
  Real radius = 0;                ///< m, mean distance of the samples from the axis
  Real misfit = 1;                ///< root mean square of the sine by which the surface leaves the motion
};

/// The axis of the surface of revolution that the samples lie on nearly: of all screws the one with the least
/// normal velocity, n·(a × p + b), area-weighted (Pottmann and Randrup 1998), outliers counting less in each of some
/// rounds. `expected` breaks ties, which spheres have: directions away from it count as if they missed by `bias` times
/// the sine of the angle.
RevolutionFit fit_revolution(const SurfaceSamples& samples, const Vec3& expected, Real bias = 0.1);

}  // namespace gracilis
