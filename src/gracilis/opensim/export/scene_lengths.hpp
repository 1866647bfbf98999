#pragma once

#include <gracilis/methods/method.hpp>
#include <gracilis/opensim/export/model_samples.hpp>
#include <gracilis/opensim/export/run_lengths.hpp>
#include <gracilis/scene/scene.hpp>

#include <functional>

namespace gracilis::opensim {

/// Values of the model's coordinates in the scene's capture pose, where the scene has them; else their default ones.
Eigen::VectorXd captured_coordinates(const Model& model, const Scene& scene);

/// Lengths and moment arms of a scene's muscles in poses spread over the box (spread_poses), each reached from the
/// capture pose at once, by a method that holds fibers in an equilibrium (strings). The capture pose comes first.
/// Coordinates outside of the box keep their capture values. A muscle with more than half of its fibers about to snap
/// has no length (nan) in that pose. The scene's axes are the model's, by their names. `fiber_points`: so many points
/// of mean fibers are kept (0: none). `progress` is told every pose. Throws ConfigurationError where the method knows
/// no moment arms, or where the box has no coordinates or too many to spread poses over.
LengthSamples scene_lengths(const Scene& scene, DeformationMethod& method, const Model& model, const CoordinateBox& box,
                            Index count, const std::function<void(Index)>& progress = {}, Index fiber_points = 0);

/// Sets line_lengths of the run's muscles whose model line the scene knows: the mean lengths of their fibers in the
/// run's poses when sections across the lines carry the surfaces (method cylinder). What the run's lengths differ by
/// from these is the muscles' own deforming; what they differ by from the model's path is also that fibers lie beside
/// the line.
void add_line_lengths(const Scene& scene, const std::filesystem::path& run, LengthSamples& samples);

/// Those of a model's coordinates that the run changes, its scene has an axis of and its muscles cross.
std::vector<Index> moved_coordinates(const LengthSamples& run, const Model& model, const Scene& scene);

}  // namespace gracilis::opensim
