#pragma once

#include <gracilis/geometry/implicit_surface.hpp>
#include <gracilis/geometry/radial_fit.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

namespace gracilis {

/// How a solid is described by radial basis functions.
struct RadialSolidSettings {
  RadialKernel kernel = {RadialShape::thin_plate};
  Index centers = 500;
  Real surface_share = 0.5;    ///< of the centers, that lie on the surface; the others on both sides of it
  Real reach_in_spacings = 1;  ///< reach of the functions, in mean distances of centers on the surface
  Real band = 0.012;           ///< m: distances are fitted up to here on both sides, and beyond only their sign
};

/// A solid as the place where a sum of radial basis functions is negative.
struct RadialSolid {
  RadialFit fit;  ///< of the distance to the surface, negative inside, that levels off at the band; m
  Eigen::AlignedBox3d bounds;
  Real band = 0;  ///< m
};

/// A distance that levels off towards the band (m, above 0), smoothly: what sums of smooth functions can follow.
Real leveled(Real distance, Real band);

/// Fits a closed surface by least squares: its vertices, points beside them on both sides, and points all over the box
/// around it. Throws InputError where the system is singular. Precondition: the surface is closed and oriented
/// outwards.
RadialSolid fit_solid(const TriangleMesh& surface, const RadialSolidSettings& settings);

/// What surface_extraction takes.
ImplicitSolid implicit_solid(const RadialSolid& solid);

}  // namespace gracilis
