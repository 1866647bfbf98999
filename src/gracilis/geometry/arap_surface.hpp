#pragma once

#include <gracilis/geometry/sparse_ldlt.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <vector>

/// As-rigid-as-possible surfaces (Sorkine and Alexa 2007): \f$\sum_{i,j} w_{ij} |(x_i - x_j) - R_i (r_i - r_j)|^2\f$
/// over vertices i and their neighbors j, r at rest, is made small by choosing rotations and places in turn.
namespace gracilis::arap {

using Rotations = std::vector<Eigen::Matrix3d>;

/// One surface with its held vertices; never changes. The matrix of the second step is factored once.
class Surface {
 public:
  /// `held` is 1 for vertices whose places are given. Weights are \f$(\cot\alpha + \cot\beta) / 2\f$ of the two angles
  /// opposite to an edge, at least `smallest_weight`. Precondition: every part of the surface has a held vertex. Throws
  /// QualityError where the vertices leave no solution.
  Surface(const TriangleMesh& mesh, const MeshTopology& topology, const std::vector<char>& held);

  /// Local step: for every vertex the rotation that turns its edges at rest best into those now.
  Rotations best_rotations(const Points& points) const;

  /// Global step: the free vertices' places where the sum is least for these rotations; held ones stay.
  void place(const Rotations& rotations, Points& points) const;

  /// Both steps in turn, so many times.
  void relax(int rounds, Points& points) const;

  /// Displacements of all vertices under forces on the free ones (3 × n), as the sum's second derivative says.
  Points response(const Points& forces) const;

  /// The sum, m².
  Real energy(const Points& points, const Rotations& rotations) const;

  static constexpr Real smallest_weight = 0.01;

 private:
  Points rest_;
  VertexStars stars_;
  std::vector<Real> weights_;   ///< one per neighbor in stars_
  std::vector<Index> unknown_;  ///< per vertex: which of the free ones, or -1
  Index unknown_count_ = 0;
  SparseLdlt factors_;
};

}  // namespace gracilis::arap
