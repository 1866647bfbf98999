#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <vector>

namespace gracilis {

/// The closed lines on which a field given at the vertices of a closed surface (linear on each triangle) has the value
/// `level`, longest first, each without repeating its first point: 3 × n, m. The field grows to the left of each line,
/// seen from outside. Vertices exactly at the level count as above it, so every line is closed. Preconditions: the
/// surface is closed and has the topology `topology`.
std::vector<Points> isocontours(const TriangleMesh& surface, const MeshTopology& topology, const Eigen::VectorXd& field,
                                Real level);

/// Length of a closed line, m.
Real closed_length(const Points& loop);

/// `count` points at equal distances along a closed line, starting at its first point.
Points resampled_loop(const Points& loop, Index count);

}  // namespace gracilis
