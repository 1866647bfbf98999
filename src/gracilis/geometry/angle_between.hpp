#pragma once

#include <gracilis/core/types.hpp>

#include <cmath>

namespace gracilis {

/// The angle between two vectors of any length, 0 to π; exact for small angles, too. 0 where one is zero.
inline Real angle_between(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// The angle of a triangle at its corner `at`.
inline Real corner_angle(const Vec3& at, const Vec3& b, const Vec3& c) { return angle_between(b - at, c - at); }

}  // namespace gracilis
