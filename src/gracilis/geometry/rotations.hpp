#pragma once

#include <gracilis/core/types.hpp>

#include <Eigen/Geometry>

namespace gracilis {

/// The smallest rotation that takes the direction of one vector to that of the other. Neither is zero; where they are
/// opposite, about any axis across them.
Eigen::Quaterniond turn_from_to(const Vec3& from, const Vec3& to);

/// The rotation R for which |R - matrix| (Frobenius) is least, no reflection: what turns one set of points best into
/// another where `matrix` is Σ to fromᵀ (Kabsch 1976).
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& matrix);

/// The rigid motion that takes `from` nearest to `to` in the least squares (Umeyama 1991); without rounding the
/// identity where they are equal. Precondition: as many points, at least one.
RigidTransform rigid_motion(const Points& from, const Points& to);

}  // namespace gracilis
