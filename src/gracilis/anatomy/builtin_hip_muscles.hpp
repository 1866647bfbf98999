#pragma once

#include <gracilis/geometry/implicit_surface.hpp>
#include <gracilis/geometry/implicit_surface_spline.hpp>
#include <gracilis/geometry/surface_extraction.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <string>
#include <vector>

namespace gracilis::builtin_hip_shapes {

/// How one muscle of the built-in hip is made: a thick sheet from origin (first row) to insertion (last row), from
/// which bones and neighbors are cut away, inflated or thinned until it has its volume.
struct MusclePlan {
  std::string name;
  ThickNet net;
  Real volume = 0;          ///< m³
  Index faces = 2000;       ///< about how many triangles
  Real roundness = 0.0035;  ///< m, standard deviation of the averaging that rounds rims and takes away thin edges
  Real origin_until = 0;    ///< share of the way from origin to insertion up to which it may be attached to the pelvis
  Real insertion_from = 1;  ///< and from which on to the femur
  int iterations = 30;      ///< of the solver, per frame; more where the muscle is pressed hard against bone
};

/// The plans in the order in which the muscles are made: deep ones first, the others make room for them.
std::vector<MusclePlan> muscle_plans();

/// Volume of the muscle `name` (without side) in a person of this height (m) and mass (kg), m³: the regression of
/// Handsfield et al. 2014 (tables 2 and 3), volume = b1 (47 height mass + 1285) + b2 in cm³. Precondition: one of the
/// six built-in muscles.
Real literature_volume(const std::string& name, Real height, Real mass);

/// What a muscle has to keep away from, and how far.
struct Obstacle {
  ImplicitSolid solid;
  Real gap = 0;  ///< m
};

struct ShapedMuscle {
  TriangleMesh surface;
  SampledSolid shape;  ///< negative inside the muscle; an obstacle for its neighbors
};

/// Makes the muscle: within 0.3 % of the plan's volume, at least (up to the chord error of its triangles) the gap away
/// from every obstacle.
ShapedMuscle shape_muscle(const MusclePlan& plan, const std::vector<Obstacle>& obstacles);

/// A sampled shape as an obstacle.
ImplicitSolid as_solid(SampledSolid shape);

}  // namespace gracilis::builtin_hip_shapes
