#pragma once

#include <gracilis/scene/scene.hpp>
#include <gracilis/simulate/arm_comparison.hpp>
#include <gracilis/view/session/coordinate_range.hpp>

#include <filesystem>
#include <vector>

namespace gracilis {

/// Moment arms of an OpenSim model's muscles about the coordinate that moves, in 200 steps of its range, for a
/// comparison with the scene's. The model's other coordinates have the values of `ranges`, else those of the scene's
/// capture pose, else their default ones. Each curve is named after the scene's muscle of the model's muscle's name;
/// where there is none, after the scene's muscle that it is a part of by the dictionary of `draft` (glut_max1_r of
/// gluteus_maximus_r). What acts about the coordinate and is of no muscle of the scene is told and left out.
/// Precondition: one range moves. Throws InputError where the model has no muscles, or not a coordinate of `ranges`, or
/// where couplers set the one that moves.
std::vector<ArmCurve> model_arms(const std::filesystem::path& file, const Scene& scene,
                                 const std::vector<CoordinateRange>& ranges);

}  // namespace gracilis
