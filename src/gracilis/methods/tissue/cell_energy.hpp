#pragma once

#include <gracilis/methods/tissue/lattice.hpp>
#include <gracilis/methods/tissue/material.hpp>

namespace gracilis::tissue {

/// What a cell is made of.
struct CellLaw {
  MatrixLaw matrix;
  Real bulk = 0;  ///< Pa, on the mean J of what is filled of the cell: on each tetrahedron it would lock them
  FiberLaw fibers;
  Vec3 direction = Vec3::Zero();  ///< of the fibers at rest, unit; 0: none
};

/// What of a cell counts in which way.
struct CellWeights {
  std::array<Real, 5> volumes{};  ///< m³, of tetrahedra
  std::array<Real, 5> shares{};   ///< in the mean J: of what is really filled, or the surface's volume would drift
  Real volume = 0;                ///< m³
};
/// Of a cell with edges of `cell_size` (m); `fills` are the filled shares of its tetrahedra.
CellWeights cell_weights(const CubeCut& cut, Real cell_size, const std::array<Real, 5>& fills);

/// Energy of a cell (J), its derivative by the corners (N), and the least J of its tetrahedra.
struct CellState {
  Real energy = 0;
  Corners gradient = Corners::Zero();
  Real least_volume_ratio = 1;
};

/// `fills`: the filled share of each tetrahedron; in its
/// stiffness it counts with `least_fill` at least. Where a tetrahedron is flat or inverted the
/// energy is infinite and the gradient means nothing.
CellState cell_energy(const CubeCut& cut, Real cell_size, const std::array<Real, 5>& fills, const CellLaw& law,
                      const Corners& corners);

using Matrix24 = Eigen::Matrix<Real, 24, 24>;
/// Second derivatives of the cell's energy by its corners. Precondition: nothing is inverted.
Matrix24 cell_hessian(const CubeCut& cut, Real cell_size, const std::array<Real, 5>& fills, const CellLaw& law,
                      const Corners& corners);

}  // namespace gracilis::tissue
