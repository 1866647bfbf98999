#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/sparse_ldlt.hpp>
#include <gracilis/geometry/topology.hpp>

#include <vector>

namespace gracilis {

/// Discrete harmonic fields on one surface with the same vertices fixed: what depends on neither their values nor the
/// conductance is done once. See harmonic_fields.
class HarmonicSolver {
 public:
  /// Surfaces with more unknowns than `largest_factorized` are solved by conjugate gradients, each time from the last
  /// fields: as fast there, in a fraction of the memory, to 1e-8. `vertices` and `topology` must outlive it.
  HarmonicSolver(const Points& vertices, const MeshTopology& topology, std::vector<Index> fixed,
                 Index largest_factorized = 30000);

  /// The fields (n × m, one per column). Throws QualityError where the vertices or conductances leave no solution.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& fixed_values, const std::vector<Real>& conductance = {});

 private:
  const Points& vertices_;
  const MeshTopology& topology_;
  std::vector<Index> fixed_, numbers_;  ///< numbers: of the unknowns; -1 where nothing is to be found
  Index unknown_count_ = 0, largest_factorized_;
  SparseLdlt factors_;
  Eigen::MatrixXd last_;  ///< solution by conjugate gradients

  Index number_of(Index vertex) const { return numbers_[static_cast<std::size_t>(vertex)]; }
  bool is_factorized() const { return unknown_count_ <= largest_factorized_; }
  /// The factorization reads no more than half of the matrix.
  bool is_read(Index row, Index column) const { return row >= column || !is_factorized(); }
  Eigen::SparseMatrix<Real> empty_laplacian() const;
  Eigen::MatrixXd iterated(const Eigen::SparseMatrix<Real>& laplacian, const Eigen::MatrixXd& right_side,
                           bool sums_to_one);
};

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
