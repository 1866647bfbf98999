#pragma once

#include <gracilis/geometry/arap_surface.hpp>

#include <vector>

/// What brings an as-rigid-as-possible surface back to its volume, of which its energy knows nothing.
namespace gracilis::arap {

/// Brings the volume enclosed by the free vertices' motion back to `target`, m³, to a millionth: x + μ y, y the
/// response to forces along the volume's gradient, μ the multiplier.
void restore_volume_by_multiplier(const Surface& surface, const Eigen::Matrix3Xi& faces, const std::vector<char>& held,
                                  Real target, Points& points);

/// The same by scaling the free vertices about the surface's center by (target / V)^(1/3), once.
void restore_volume_by_scaling(const Eigen::Matrix3Xi& faces, const std::vector<char>& held, Real target,
                               Points& points);

}  // namespace gracilis::arap
