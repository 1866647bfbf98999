#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <array>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace gracilis::tissue {

/// Positions of the eight corners of a cell; corner c lies at the cell's upper side along x, y, z where bit 0, 1, 2 of
/// c is set.
using Corners = Eigen::Matrix<Real, 3, 8>;

/// A cube cut into five tetrahedra: one in the middle, and one at every other corner. Neighboring cubes are cut as
/// mirror images, so that the faces between them are cut alike.
struct CubeCut {
  std::array<std::array<Index, 4>, 5> tetrahedra;            ///< corners, positively oriented; the middle one first
  std::array<Real, 5> shares;                                ///< of the cube's volume
  std::array<Eigen::Matrix<Real, 3, 4>, 5> shape_gradients;  ///< of a cube with edge 1: \f$F = \sum x_k \otimes g_k\f$
};

/// The tetrahedron with this point, and the weights of its corners there; the point in units of the cube's edge, from
/// its corner 0. Weights are negative only outside of the cube.
std::pair<std::size_t, Eigen::Vector4d> locate(const CubeCut& cut, const Vec3& in_cube);

/// The cut of a cell whose place in the lattice has an even (0) or odd (1) sum.
const CubeCut& cube_cut(int parity);

struct Cell {
  std::array<Index, 8> nodes;
  std::array<Index, 3> place;  ///< in the lattice
  int parity = 0;
  std::array<Real, 5> fills{1, 1, 1, 1, 1};  ///< share of each tetrahedron that lies inside the surface
  Real fill = 1;                             ///< of all of the cell
};

/// A point as a mean of a tetrahedron's corners.
struct EmbeddedPoint {
  Index cell = -1;
  std::array<Index, 4> nodes{0, 0, 0, 0};  ///< of the lattice
  Eigen::Vector4d weights = Eigen::Vector4d::Zero();
};

/// A surface inside a regular lattice of cubes.
struct Lattice {
  Vec3 origin = Vec3::Zero();  ///< m, of the place (0, 0, 0)
  Real cell_size = 0;          ///< m
  std::array<Index, 3> size{0, 0, 0};
  Points nodes;             ///< at rest, 3 × n, m
  std::vector<Cell> cells;  ///< ordered by z, y, x of their place
  std::unordered_map<std::int64_t, Index> cell_at;

  Index node_count() const { return static_cast<Index>(nodes.cols()); }   ///< corners of cells, shared ones once
  Index cell_count() const { return static_cast<Index>(cells.size()); }   ///< all that are kept
  Real cell_volume() const { return cell_size * cell_size * cell_size; }  ///< m³, of the whole cube
};

/// The least share that a tetrahedron counts as filled with where stiffness is meant: thin sheets and tendons keep
/// some.
inline constexpr Real least_fill = 0.05;

/// All cells that the surface passes through or that lie inside it. Preconditions: at least one face, finite
/// coordinates, cell_size above 0.
Lattice build_lattice(const TriangleMesh& surface, Real cell_size);

/// Where a point lies in the lattice; cell -1 outside of all cells.
EmbeddedPoint embed(const Lattice& lattice, const Vec3& p);

/// How much of a cell lies inside the surface, m³.
Real filled_volume(const Lattice& lattice, const Cell& cell);

/// What the lattice's tissue fills of space where its nodes are at `nodes`, over that at rest.
Real filled_volume_ratio(const Lattice& lattice, const Points& nodes);

/// A cell's corners where the nodes are at `nodes`.
inline Corners corners_of(const Cell& cell, const Points& nodes) {
  Corners corners;
  for (int c = 0; c < 8; ++c) corners.col(c) = nodes.col(cell.nodes[static_cast<std::size_t>(c)]);
  return corners;
}

/// Calls act(cell, t, ratio) for every tetrahedron t of every cell: its volume where the nodes are at `nodes`,
/// over that at rest.
template <class Act>
void for_each_volume_ratio(const Lattice& lattice, const Points& nodes, const Act& act) {
  for (const Cell& cell : lattice.cells) {
    const CubeCut& cut = cube_cut(cell.parity);
    const Corners corners = corners_of(cell, nodes);
    for (std::size_t t = 0; t < 5; ++t) {
      const std::array<Index, 4>& of = cut.tetrahedra[t];
      const Vec3 first = corners.col(of[0]), a = corners.col(of[1]) - first, b = corners.col(of[2]) - first,
                 c = corners.col(of[3]) - first;
      act(cell, t, a.cross(b).dot(c) / (6 * cut.shares[t] * lattice.cell_volume()));
    }
  }
}

/// The mean of what the lattice's nodes have, 3 × nodes.
inline Vec3 mean_at(const EmbeddedPoint& point, const Points& of_nodes) {
  Vec3 mean = Vec3::Zero();
  for (std::size_t k = 0; k < 4; ++k) mean += point.weights[static_cast<Index>(k)] * of_nodes.col(point.nodes[k]);
  return mean;
}

}  // namespace gracilis::tissue
