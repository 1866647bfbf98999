#pragma once

#include <gracilis/scene/scene.hpp>

#include <string>
#include <vector>

namespace gracilis {

/// A motion through key poses (rows × coordinates, rad) with equal steps between each two, as many as it takes for no
/// coordinate to change by more than `step` (rad, positive); `time_step` s between rows, starting at 0.
Motion motion_through(const std::vector<std::string>& coordinates, const Eigen::MatrixXd& key_poses, Real step,
                      Real time_step);

/// Keeps the rows from `begin` to `end` (s), and of those the first and each that follows the last one kept by at least
/// `time_step` (s, less a millionth for rounding).
void thin_out(Motion& motion, Real begin, Real end, Real time_step);

/// Drops the columns of coordinates that are not among `known`; returns their names.
std::vector<std::string> drop_unknown_coordinates(Motion& motion, const std::vector<std::string>& known);

}  // namespace gracilis
