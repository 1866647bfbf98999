#pragma once

#include <gracilis/study/run_record.hpp>

#include <string>
#include <vector>

namespace gracilis {

inline constexpr const char* trajectory_file = "trajectories.h5";  ///< in the study's folder

struct TrajectoryEnd {
  int runs = 0;                      ///< that were written
  std::vector<std::string> skipped;  ///< a line for each complete run that is not in the file, and why
};

/// Writes trajectories.h5 into the study's folder, whole or not at all; per complete run, in the study's order:
///
///   /runs/NAME               attributes scene, parameters and values
///     time                   frames, s
///     coordinates            frames × coordinates, attribute columns, as in hip_flexion_r_deg
///     measures/METRIC        frames × muscles, attribute columns
///     muscles/MUSCLE/        faces (m × 3), vertices (frames × n × 3, m), fiber_points (frames × p × 3, m) of lines
///                            that begin at fiber_offsets
///     bones/BONE/            faces, vertices (frames × n × 3)
///
/// Throws InputError where it cannot be written.
TrajectoryEnd write_trajectories(const Study& study, const std::string& version);

}  // namespace gracilis
