#pragma once

#include <gracilis/geometry/polylines.hpp>
#include <gracilis/opensim/reader/model.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gracilis::opensim {

/// A muscle's mean length over its fibers, a row per pose.
struct MuscleLengths {
  std::string name;
  Eigen::VectorXd lengths;  ///< m
  Eigen::MatrixXd arms;     ///< -dL/dq, poses × coordinates of the model; without columns: not known
  /// m, of the same fibers if the muscle's surface followed the model's line (add_line_lengths); empty: not known.
  Eigen::VectorXd line_lengths = {};
  /// The mean fiber in each pose, 3 × points, where a scene was asked for it (scene_lengths); otherwise empty.
  std::vector<Points> fibers = {};
};

/// Lengths in poses, the first of which is the capture pose.
struct LengthSamples {
  Eigen::MatrixXd coordinates;  ///< poses × coordinates of the model, rad or m
  std::vector<MuscleLengths> muscles;
  bool follow_lines = false;  ///< the muscles' sections follow the model's own paths, wherever these run
  bool spread = false;        ///< the poses are spread over the coordinates' ranges instead of following a motion
  /// Of the scene's bodies in each pose, where a scene was asked (scene_lengths); otherwise empty.
  std::vector<std::vector<RigidTransform>> scene_poses = {};
};

/// The mean of fibers, `count` points along it; none where there are none.
Points mean_fiber(const Polylines& fibers, Index count);

/// The lengths in a run's fiber_lengths.sto and, where there are some, its moment_arms_*.sto. What the scene moves
/// beside its coordinates (knee_r_translation1) counts as what it is in the model. Throws InputError where there are
/// none, or where the run does not move.
LengthSamples run_lengths(const std::filesystem::path& run, const Model& model);

/// The joints and coordinates alone of the scene that a run was made of, from its manifest. Throws InputError where
/// the run is too old to tell.
Model joints_of_run(const std::filesystem::path& run);

/// The component's path by which OpenSim knows a coordinate: /jointset/hip_r/hip_flexion_r.
std::string coordinate_path(const Model& model, Index coordinate);

}  // namespace gracilis::opensim
