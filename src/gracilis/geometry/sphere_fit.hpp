#pragma once

#include <gracilis/geometry/surface_samples.hpp>

#include <functional>

namespace gracilis {

/// A sphere that a part of a surface lies on.
struct SphereFit {
  Vec3 center = Vec3::Zero();
  Real radius = 0;    ///< 0: none was found
  Real share = 0;     ///< of the sphere's area that the surface covers, 0 to 1
  Real residual = 0;  ///< m, root mean square of the covering samples' distances from it
};

/// What speaks for a sphere besides the surface: a factor, 0 for one that cannot be.
using SphereLiking = std::function<Real(const Vec3& center, Real radius)>;

/// The outward sphere with a radius in the given range of which the samples cover most (times `liking`): guesses from
/// pairs of samples with their normals, each judged by the area within 4 % of the radius and 25 degrees of the normal
/// (RANSAC, Fischler and Bolles 1981; the same pairs for the same surface), then least squares over what covers it.
SphereFit fit_sphere(const SurfaceSamples& samples, Real radius_min, Real radius_max, const SphereLiking& liking = {});

}  // namespace gracilis
