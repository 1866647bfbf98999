#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/topology.hpp>

#include <vector>

namespace gracilis {

/// Discrete harmonic fields on a surface, one per column of `fixed_values`: at every vertex of `fixed` the given value,
/// at every other the mean of its neighbors weighted by 1 / edge length. The weights are positive, so values stay
/// between the smallest and the largest fixed one. Vertices in a component without a fixed vertex get 0. Shapes: fixed
/// k vertices; fixed_values k × m; result n × m. Preconditions: no edge joins two coinciding free vertices closer than
/// 1e-9 m (such lengths are clamped there). `conductance`, where given, is positive, one per edge of the topology, and
/// multiplies that edge's weight.
Eigen::MatrixXd harmonic_fields(const Points& vertices, const MeshTopology& topology, const std::vector<Index>& fixed,
                                const Eigen::MatrixXd& fixed_values, const std::vector<Real>& conductance = {});

/// Gradient of a field given at the vertices, constant on each triangle, 1/m times the field's unit; zero on degenerate
/// ones. Shape: 3 × faces.
Points face_gradients(const Points& vertices, const Eigen::Matrix3Xi& faces, const Eigen::VectorXd& field);

}  // namespace gracilis
