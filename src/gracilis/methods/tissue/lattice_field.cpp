#include <gracilis/methods/tissue/lattice_field.hpp>

#include <gracilis/geometry/sparse_ldlt.hpp>

#include <algorithm>

namespace gracilis::tissue {

namespace {

/// Of a cell's own stiffness: makes parts of the lattice that nothing grips solvable, and moves no value that counts.
constexpr Real least_grip = 1e-9;

using Triplets = std::vector<Eigen::Triplet<Real>>;

void add_laplacian(const Lattice& lattice, Triplets& entries) {
  for (const Cell& cell : lattice.cells) {
    const CubeCut& cut = cube_cut(cell.parity);
    for (std::size_t t = 0; t < 5; ++t) {
      const Eigen::Matrix4d k = std::max(least_fill, cell.fills[t]) * cut.shares[t] * lattice.cell_size *
                                (cut.shape_gradients[t].transpose() * cut.shape_gradients[t]);
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
          entries.emplace_back(cell.nodes[static_cast<std::size_t>(cut.tetrahedra[t][i])],
                               cell.nodes[static_cast<std::size_t>(cut.tetrahedra[t][j])],
                               k(static_cast<Index>(i), static_cast<Index>(j)));
    }
  }
  for (Index n = 0; n < lattice.node_count(); ++n) entries.emplace_back(n, n, least_grip * lattice.cell_size);
}

Eigen::MatrixXd solve(const Lattice& lattice, const Triplets& entries, const Eigen::MatrixXd& right) {
  Eigen::SparseMatrix<Real> matrix(lattice.node_count(), lattice.node_count());
  matrix.setFromTriplets(entries.begin(), entries.end());
  SparseLdlt factors;
  factors.factor(matrix,
                 "the harmonic fields of a tissue lattice have no solution: its cells or what grips it are not finite, "
                 "or far too large or small");
  return factors.solve(right);
}

}  // namespace

Eigen::MatrixXd harmonic_lattice_fields(const Lattice& lattice, const std::vector<FieldGrip>& grips, Index columns) {
  Triplets entries;
  add_laplacian(lattice, entries);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(lattice.node_count(), columns);
  for (const FieldGrip& grip : grips) {
    for (std::size_t i = 0; i < 4; ++i) {
      const Index node = grip.at.nodes[i];
      const Real weight = grip.grip * grip.at.weights[static_cast<Index>(i)];
      if (grip.column >= 0 && grip.column < columns) right(node, grip.column) += weight;
      for (std::size_t j = 0; j < 4; ++j)
        entries.emplace_back(node, grip.at.nodes[j], weight * grip.at.weights[static_cast<Index>(j)]);
    }
  }
  return solve(lattice, entries, right);
}

Eigen::VectorXd fed_lattice_field(const Lattice& lattice, const std::vector<FieldSource>& sources) {
  Triplets entries;
  add_laplacian(lattice, entries);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(lattice.node_count());
  for (const FieldSource& source : sources)
    for (std::size_t k = 0; k < 4; ++k)
      right[source.at.nodes[k]] += source.flow * source.at.weights[static_cast<Index>(k)];
  return solve(lattice, entries, right);
}

Points cell_gradients(const Lattice& lattice, const Eigen::VectorXd& field) {
  Points gradients = Points::Zero(3, lattice.cell_count());
  for (Index c = 0; c < lattice.cell_count(); ++c)
    for (Index corner = 0; corner < 8; ++corner) {
      const Vec3 side((corner & 1) ? 1 : -1, (corner & 2) ? 1 : -1, (corner & 4) ? 1 : -1);
      const Index node = lattice.cells[static_cast<std::size_t>(c)].nodes[static_cast<std::size_t>(corner)];
      gradients.col(c) += field[node] / (4 * lattice.cell_size) * side;
    }
  return gradients;
}

}  // namespace gracilis::tissue
