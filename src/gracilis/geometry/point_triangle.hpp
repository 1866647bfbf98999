#pragma once

#include <gracilis/core/types.hpp>

namespace gracilis {

/// The point of triangle (a, b, c) nearest to p, as barycentric coordinates: each in [0, 1], summing to 1. Exactly one
/// coordinate is zero when the point lies on an edge, two when it is a corner. Degenerate triangles answer with the
/// nearest point of one of their edges. Voronoi regions after Ericson, Real-Time Collision Detection, 2005,
/// section 5.1.5.
Vec3 nearest_barycentric(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);
/// The same in single precision.
Eigen::Vector3f nearest_barycentric(const Eigen::Vector3f& p, const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                                    const Eigen::Vector3f& c);

}  // namespace gracilis
