#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/topology.hpp>

namespace gracilis {

// Of a round of smoothing, Taubin 1995, with a pass-band of 0.11: the step forth to the mean of the neighbors, and
// back.
inline constexpr Real smoothing_forth = 0.5, smoothing_back = -0.53;

/// Every vertex moves by `factor` · weight of the way to the mean of its neighbors.
void move_to_means(Points& vertices, const VertexStars& stars, const Eigen::VectorXd& weights, Real factor);

/// Each round takes every vertex half of the way to the mean of its neighbors and then slightly more than that back,
/// which flattens bumps of about an edge and keeps larger shapes and nearly the volume (Taubin 1995).
void smooth_points(Points& vertices, const VertexStars& stars, int rounds);
/// The same in single precision, for what is drawn: four numbers a vertex, of which the last says nothing.
void smooth_points(Eigen::Matrix4Xf& vertices, const VertexStars& stars, int rounds);

/// Takes those back that are farther than `farthest` (m) from where they were at the start, as far as that.
void keep_within(Real farthest, const Points& start, Points& vertices);

}  // namespace gracilis
