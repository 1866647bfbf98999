#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/radial_fit.hpp>

#include <vector>

/// Where the centers of radial basis functions go (Cervenka 2024, sections 3.1.3, 5.1 to 5.6).
namespace gracilis {

/// Heights at the nodes of a regular grid over the x-y plane: node (i, j) lies at step (i, j, 0), height j * columns +
/// i.
struct HeightField {
  Index columns = 0, rows = 0;
  Real step = 1;  ///< m
  Eigen::VectorXd heights;

  Real at(Index i, Index j) const { return heights[j * columns + i]; }
  Vec3 node(Index i, Index j) const { return step * Vec3(i, j, 0); }
  Points nodes() const;  ///< in the order of the heights
  Eigen::AlignedBox3d box() const;
};

/// The nodes of a grid over the box, its corners included; along an axis with one node, the middle.
Points grid_centers(const Eigen::AlignedBox3d& box, const Eigen::Vector3i& counts);

/// The first `count` points of the Halton sequence in bases 2, 3 and 5 (Halton 1960), inside the box.
Points halton_centers(const Eigen::AlignedBox3d& box, Index count);

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

/// `count` of the points that spread over all of them: the first, then always the one farthest from those taken. All
/// where there are fewer.
Points spread_out(const Points& points, Index count);

/// Exactly `count` centers: the given ones spread out, then those of the Halton sequence in the box that are nearest to
/// none of the taken ones. Points given twice count once.
Points filled_up(const Points& points, Index count, const Eigen::AlignedBox3d& box);

/// Greedy fit: again and again a center at the point where the fit is worst, with the reach among `reaches` whose
/// function alone takes most of what is left, and all weights anew by least squares; until there are `count`.
RadialFit fit_greedily(const RadialFitSettings& settings, const Points& points, const Eigen::VectorXd& values,
                       const std::vector<Real>& reaches, Index count);

/// Mean squared error of a fit at points.
Real mean_squared_error(const RadialBasis& basis, const Points& points, const Eigen::VectorXd& values);

}  // namespace gracilis
