#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/radial_fit.hpp>

#include <vector>

/// Where the centers of radial basis functions go (Cervenka 2024, sections 3.1.3, 5.1 to 5.6).
namespace gracilis {

/// The nodes of a grid over the box, its corners included; along an axis with one node, the middle.
Points grid_centers(const Eigen::AlignedBox3d& box, const Eigen::Vector3i& counts);

/// The first `count` points of the Halton sequence in bases 2, 3 and 5 (Halton 1960), inside the box.
Points halton_centers(const Eigen::AlignedBox3d& box, Index count);

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
