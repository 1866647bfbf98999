#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

/// The few types that every other file speaks in. Lengths are metres, angles radians, everywhere.
namespace gracilis {

using Real = double;
using Index = int;

using Vec3 = Eigen::Vector3d;

/// n points as the columns of a 3 × n matrix (NumPy sees (n, 3) without a copy).
using Points = Eigen::Matrix3Xd;

/// A rotation followed by a translation: p ↦ R p + t.
using RigidTransform = Eigen::Isometry3d;

inline constexpr Real pi = 3.14159265358979323846;

constexpr Real radians(Real degrees) { return degrees * (pi / 180); }  ///< of an angle in degrees
constexpr Real degrees(Real radians) { return radians * (180 / pi); }  ///< of an angle in radians

}  // namespace gracilis
