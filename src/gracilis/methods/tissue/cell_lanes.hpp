#pragma once

#include <gracilis/dynamics/simd/group_width.hpp>
#include <gracilis/methods/tissue/cell_energy.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace gracilis::tissue {

/// So many cells that are cut alike stand side by side for the vector kernel, in double precision.
inline constexpr Index cells_in_group = group_width / 2;

/// A lattice's cells as the kernel reads them. What is told per tetrahedron or corner t of a group stands at
/// (group · count + t) · cells_in_group + lane, where count is 5 or 8. Lanes beyond the last cell repeat one that
/// weighs nothing.
struct CellLanes {
  Real cell_size = 0;
  std::vector<int> parities;          ///< of groups
  std::vector<Index> cells;           ///< of groups' lanes; -1 beyond the last cell
  std::vector<std::int64_t> corners;  ///< where a corner's node begins in a 3 × n matrix
  std::vector<Real> volumes;          ///< m³, of tetrahedra, by what they count with
  std::vector<Real> shares;           ///< of tetrahedra in the mean J
  std::vector<std::size_t> slot;      ///< of cells: where their corner 0 stands; the others follow by whole groups

  Index group_count() const { return static_cast<Index>(parities.size()); }  ///< of cells of one parity
  std::size_t corner_count() const { return corners.size(); }  ///< of all groups, lanes that are left over included
};

/// The lattice's cells in groups of one parity; lanes that are left over stand on their group's first cell and have no
/// volume.
CellLanes cell_lanes(const Lattice& lattice);

/// The laws of the cells, a number per lane of each group.
struct LawLanes {
  std::vector<Real> shear, lambda, bulk;                       ///< Pa
  std::vector<Real> stiffening;                                ///< of MatrixLaw
  std::vector<Real> rest_tension, stiffness, active, optimal;  ///< of FiberLaw; no tension where there is no direction
  std::vector<Real> least_strain;                              ///< where fibers go slack
  std::array<std::vector<Real>, 3> direction;
  bool any_active = false;
  Real least_volume_ratio = 0;  ///< below it a tetrahedron counts as inverted
  Real pressure = 0;            ///< Pa, alike in all cells: what is missing of the muscle's volume makes it grow
};

/// One law per cell of the lattice; lanes that are left over take that of their group's first cell.
LawLanes law_lanes(const CellLanes& cells, const std::vector<CellLaw>& laws);

/// Derivatives of the cells' energy by their corners (N), a number per corner and axis.
using CornerForces = std::array<std::vector<Real>, 3>;

/// `cell_energy` of all cells of some groups (J), and its derivatives into the corners' places of `forces`. Infinite
/// where a tetrahedron is inverted; the forces mean nothing then.
Real cell_lane_energy(const CellLanes& cells, const LawLanes& laws, Index begin_group, Index end_group,
                      const Points& nodes, CornerForces& forces);

}  // namespace gracilis::tissue
