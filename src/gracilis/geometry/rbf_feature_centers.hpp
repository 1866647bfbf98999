#pragma once

#include <gracilis/core/types.hpp>

#include <Eigen/Geometry>

/// Centers of radial basis functions at the features of a height field (Cervenka 2024, sections 5.1 to 5.6).
namespace gracilis {

/// Heights at the nodes of a regular grid over the x-y plane: node (i, j) lies at step (i, j, 0), height j * columns +
/// i.
struct HeightField {
  Index columns = 0, rows = 0;
  Real step = 1;  ///< m
  Eigen::VectorXd heights;

  Real at(Index i, Index j) const { return heights[j * columns + i]; }  ///< m
  Vec3 node(Index i, Index j) const { return step * Vec3(i, j, 0); }    ///< m, in the plane
  Points nodes() const;                                                 ///< in the order of the heights
  Eigen::AlignedBox3d box() const;                                      ///< m, with the heights
};

/// Nodes higher or lower than all eight around them.
Points extremum_centers(const HeightField& field);

/// Nodes beside which the curvature (half the Laplacian) changes its sign.
Points inflection_centers(const HeightField& field);

/// Nodes where the curvature is stationary: higher or lower than at all eight around, or a saddle.
Points curvature_centers(const HeightField& field);

/// Edges by Canny's detector (1986): the slope is largest across the edge there, above `high` of the steepest, or above
/// `low` of it and joined to such.
Points edge_centers(const HeightField& field, Real low = 0.3, Real high = 0.6);

/// The corners of the field and `between` centers evenly along each of its sides.
Points border_centers(const HeightField& field, Index between);

}  // namespace gracilis
