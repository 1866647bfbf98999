#pragma once

#include <gracilis/scene/scene.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace gracilis {

/// Most frames of a run, unless its scene says otherwise: more come of a slip in a step.
inline constexpr int default_max_frames = 1'000'000;

/// Steps from one value to another that change by `step` (positive) at most: `change` over `step` rounded up, one at
/// least. A tolerance keeps a change of exactly n steps at n whatever the rounding. Beyond 2^62, and where the quotient
/// is no number, 2^62.
std::int64_t steps_over(Real change, Real step);

/// Throws ConfigurationError where a run would have more than `max_frames` frames.
void require_frames(std::int64_t frames, int max_frames);

/// A motion through key poses (rows × coordinates, rad) with equal steps between each two, as many as it takes for no
/// coordinate to change by more than `step` (rad, positive); `time_step` s between rows, starting at 0. Throws
/// ConfigurationError instead of making more than `max_frames` rows.
Motion motion_through(const std::vector<std::string>& coordinates, const Eigen::MatrixXd& key_poses, Real step,
                      Real time_step, int max_frames = default_max_frames);

/// From one value to another in equal steps of `step` (positive) at most. Throws ConfigurationError instead of giving
/// more than `max_count` values.
Eigen::VectorXd values_through(Real from, Real to, Real step, int max_count = default_max_frames);

/// A motion through all combinations of the coordinates' values (one list per coordinate, none empty): the first
/// coordinate changes with every row, to and fro, so that two neighboring rows differ in one coordinate by one step;
/// `time_step` s between rows, starting at 0. Throws ConfigurationError instead of making more than `max_frames` rows.
Motion motion_over_grid(const std::vector<std::string>& coordinates, const std::vector<Eigen::VectorXd>& values,
                        Real time_step, int max_frames = default_max_frames);

/// Keeps the rows from `begin` to `end` (s), and of those the first and each that follows the last one kept by at least
/// `time_step` (s, less a millionth for rounding).
void thin_out(Motion& motion, Real begin, Real end, Real time_step);

/// Drops the columns of coordinates that are not among `known`; returns their names.
std::vector<std::string> drop_unknown_coordinates(Motion& motion, const std::vector<std::string>& known);

}  // namespace gracilis
