#pragma once

#include <gracilis/anatomy/fibers/fiber_field.hpp>
#include <gracilis/geometry/polylines.hpp>
#include <gracilis/scene/scene.hpp>

#include <vector>

namespace gracilis {

/// What measured tracts say: per tract its directions along it, each that of the line which fits a third of the tract
/// best, so that the steps' noise does not count; where tracts leave the grid they say nothing. Weights are lengths.
std::vector<DirectionSample> samples_of_tracts(const SolidGrid& grid, const Polylines& tracts);

/// The harmonic field in the grid that is 0 at the muscle's origin and 1 at its insertion, per node.
Eigen::VectorXd inner_origin_to_insertion(const SolidGrid& grid, const Muscle& muscle);

/// How a field grows at a place, in its unit per step of the grid.
Vec3 field_growth(const SolidGrid& grid, const Eigen::VectorXd& field, const Vec3& p);

/// Turns tracts so that each as a whole runs the way the field grows.
void turn_along(const SolidGrid& grid, const Eigen::VectorXd& field, std::vector<DirectionSample>& samples);

}  // namespace gracilis
