#pragma once

#include <gracilis/geometry/implicit_surface.hpp>
#include <gracilis/geometry/implicit_surface_spline.hpp>
#include <gracilis/geometry/surface_extraction.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <string>
#include <vector>

namespace gracilis::builtin_shapes {

/// How one muscle of a built-in scene is made: a thick sheet from origin (first row) to insertion (last row), from
/// which bones and neighbors are cut away, its belly inflated or thinned until it has its volume.
struct MusclePlan {
  std::string name;
  ThickNet net;
  Real volume = 0;          ///< m³
  Index faces = 2000;       ///< about how many triangles
  Real roundness = 0.0035;  ///< m, standard deviation of the averaging that rounds rims and takes away thin edges
  Real origin_until = 0;    ///< share of the way from origin to insertion up to which it may be attached at its origin
  Real insertion_from = 1;  ///< and from which on at its insertion
  int iterations = 30;      ///< of the solver, per frame; more where the muscle is pressed hard against bone
  Index origin_body = 0;    ///< whose bones the origin grows on; indices into the scene's bodies
  Index insertion_body = 1;
  Real belly_from = 0;  ///< share of the way where the belly begins; before it the tendon is as thick as the sheet says
  Real belly_until = 1;  ///< and where it ends; 0 and 1: all is belly
};

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

}  // namespace gracilis::builtin_shapes
