#include <gracilis/methods/tissue/lattice.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/signed_distance.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace gracilis::tissue {

namespace {

constexpr int samples_per_edge = 6;  // of a tetrahedron, to measure how full it is: 56 in all

Vec3 unit_corner(Index c) {
  return {static_cast<Real>(c & 1), static_cast<Real>((c >> 1) & 1), static_cast<Real>(c >> 2)};
}

CubeCut make_cut(int parity) {
  CubeCut cut{};
  // The corners with an odd (even) number of bits are the middle tetrahedron's; the others have one each.
  std::size_t next = 1, middle = 0;
  for (Index c = 0; c < 8; ++c) {
    const bool is_odd = std::popcount(static_cast<unsigned>(c)) % 2 == 1;
    if (is_odd != (parity == 1))
      cut.tetrahedra[0][middle++] = c;
    else
      cut.tetrahedra[next++] = {c, c ^ 1, c ^ 2, c ^ 4};
  }
  for (std::size_t t = 0; t < 5; ++t) {
    auto& corners = cut.tetrahedra[t];
    const auto edges = [&] {
      Eigen::Matrix3d e;
      for (Index k = 0; k < 3; ++k)
        e.col(k) = unit_corner(corners[static_cast<std::size_t>(k) + 1]) - unit_corner(corners[0]);
      return e;
    };
    if (edges().determinant() < 0) std::swap(corners[2], corners[3]);
    cut.shares[t] = edges().determinant() / 6;
    cut.shape_gradients[t].rightCols<3>() = edges().inverse().transpose();
    cut.shape_gradients[t].col(0) = -cut.shape_gradients[t].rightCols<3>().rowwise().sum();
  }
  return cut;
}

std::array<Index, 3> place_at(const Lattice& lattice, const Vec3& p) {
  const Vec3 place = (p - lattice.origin) / lattice.cell_size;
  return {static_cast<Index>(std::floor(place.x())), static_cast<Index>(std::floor(place.y())),
          static_cast<Index>(std::floor(place.z()))};
}

/// A number for a place; `wider` is 1 for nodes, of which there is one more than cells along each axis.
std::int64_t number_of(const Lattice& lattice, const std::array<Index, 3>& place, int wider = 0) {
  const std::int64_t nx = lattice.size[0] + wider, ny = lattice.size[1] + wider;
  return place[0] + nx * (place[1] + ny * std::int64_t{place[2]});
}

/// Marks the cells that the surface passes through, by points on its triangles closer together than a quarter cell.
std::vector<char> cells_at_surface(const Lattice& lattice, const TriangleMesh& surface) {
  std::vector<char> marked(static_cast<std::size_t>(lattice.size[0]) * static_cast<std::size_t>(lattice.size[1]) *
                           static_cast<std::size_t>(lattice.size[2]));
  const auto mark = [&](const Vec3& p) {
    marked[static_cast<std::size_t>(number_of(lattice, place_at(lattice, p)))] = 1;
  };
  for (Index f = 0; f < surface.face_count(); ++f) {
    const Vec3 a = surface.vertices.col(surface.faces(0, f)), b = surface.vertices.col(surface.faces(1, f)),
               c = surface.vertices.col(surface.faces(2, f));
    const Real longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    const int pieces = 1 + static_cast<int>(longest / (0.25 * lattice.cell_size));
    for (int i = 0; i <= pieces; ++i)
      for (int j = 0; i + j <= pieces; ++j) mark(a + (i * (b - a) + j * (c - a)) / pieces);
  }
  for (Index v = 0; v < surface.vertex_count(); ++v) mark(surface.vertices.col(v));
  return marked;
}

/// The barycentric coordinates of the middles of a tetrahedron's equal parts: the same in all of its directions.
std::vector<Eigen::Vector4d> sample_weights() {
  std::vector<Eigen::Vector4d> weights;
  for (int i = 0; i < samples_per_edge; ++i)
    for (int j = 0; i + j < samples_per_edge; ++j)
      for (int k = 0; i + j + k < samples_per_edge; ++k)
        weights.push_back((Eigen::Vector4d(i, j, k, samples_per_edge - 1 - i - j - k).array() + 0.25) /
                          samples_per_edge);
  return weights;
}

/// The shares of the cell's tetrahedra that lie inside, by samples.
std::array<Real, 5> filled_shares_of(const CubeCut& cut, const Lattice& lattice, const Vec3& low,
                                     const SignedDistance& distance) {
  static const std::vector<Eigen::Vector4d> samples = sample_weights();
  std::array<Real, 5> inside{};
  for (std::size_t t = 0; t < 5; ++t) {
    Eigen::Matrix<Real, 3, 4> corners;
    for (std::size_t k = 0; k < 4; ++k)
      corners.col(static_cast<Index>(k)) = low + lattice.cell_size * unit_corner(cut.tetrahedra[t][k]);
    for (const Eigen::Vector4d& weights : samples)
      if (distance.query(corners * weights).distance < 0) inside[t] += 1;
    inside[t] /= static_cast<Real>(samples.size());
  }
  return inside;
}

/// The filled shares of every place's tetrahedra; -1 where there is no cell.
std::vector<std::array<Real, 5>> filled_shares(const Lattice& lattice, const TriangleMesh& surface) {
  const std::vector<char> marked = cells_at_surface(lattice, surface);
  const SignedDistance distance(surface);
  std::vector<std::array<Real, 5>> fills(marked.size(), {-1, -1, -1, -1, -1});
  const Index rows = lattice.size[1] * lattice.size[2];
  parallel_for(rows, 1, [&](Index begin, Index end) {
    for (Index row = begin; row < end; ++row) {
      const Index j = row % lattice.size[1], k = row / lattice.size[1];
      // Between two cells at the surface a row is inside or outside all along.
      bool is_known = false, inside = false;
      for (Index i = 0; i < lattice.size[0]; ++i) {
        const auto at = static_cast<std::size_t>(i + lattice.size[0] * row);
        const Vec3 low = lattice.origin + lattice.cell_size * Vec3(i, j, k);
        if (marked[at]) {
          fills[at] = filled_shares_of(cube_cut((i + j + k) % 2), lattice, low, distance);
          is_known = false;
          continue;
        }
        if (!is_known) inside = distance.query(low + Vec3::Constant(lattice.cell_size / 2)).distance < 0;
        is_known = true;
        if (inside) fills[at] = {1, 1, 1, 1, 1};
      }
    }
  });
  return fills;
}

void add_cells(const std::vector<std::array<Real, 5>>& all_fills, Lattice& lattice) {
  std::unordered_map<std::int64_t, Index> node_at;
  std::vector<Vec3> nodes;
  for (Index k = 0; k < lattice.size[2]; ++k)
    for (Index j = 0; j < lattice.size[1]; ++j)
      for (Index i = 0; i < lattice.size[0]; ++i) {
        const std::int64_t number = number_of(lattice, {i, j, k});
        const std::array<Real, 5>& fills = all_fills[static_cast<std::size_t>(number)];
        if (fills[0] < 0) continue;
        Cell cell{{}, {i, j, k}, (i + j + k) % 2, fills, 0};
        for (std::size_t t = 0; t < 5; ++t) {
          cell.fill += cube_cut(cell.parity).shares[t] * std::max(least_fill, fills[t]);
        }
        for (Index c = 0; c < 8; ++c) {
          const std::array<Index, 3> place = {i + (c & 1), j + ((c >> 1) & 1), k + (c >> 2)};
          const auto [found, is_new] =
              node_at.try_emplace(number_of(lattice, place, 1), static_cast<Index>(nodes.size()));
          if (is_new) nodes.emplace_back(lattice.origin + lattice.cell_size * Vec3(place[0], place[1], place[2]));
          cell.nodes[static_cast<std::size_t>(c)] = found->second;
        }
        lattice.cell_at.emplace(number, lattice.cell_count());
        lattice.cells.push_back(cell);
      }
  lattice.nodes.resize(3, static_cast<Index>(nodes.size()));
  for (std::size_t n = 0; n < nodes.size(); ++n) lattice.nodes.col(static_cast<Index>(n)) = nodes[n];
}

}  // namespace

const CubeCut& cube_cut(int parity) {
  static const std::array<CubeCut, 2> cuts = {make_cut(0), make_cut(1)};
  return cuts[static_cast<std::size_t>(parity)];
}

std::pair<std::size_t, Eigen::Vector4d> locate(const CubeCut& cut, const Vec3& in_cube) {
  std::pair<std::size_t, Eigen::Vector4d> best;
  Real least = -std::numeric_limits<Real>::infinity();
  for (std::size_t t = 0; t < 5; ++t) {
    Eigen::Vector4d weights = cut.shape_gradients[t].transpose() * (in_cube - unit_corner(cut.tetrahedra[t][0]));
    weights[0] += 1;
    if (weights.minCoeff() <= least) continue;
    least = weights.minCoeff();
    best = {t, weights};
  }
  return best;
}

Lattice build_lattice(const TriangleMesh& surface, Real cell_size) {
  Lattice lattice;
  lattice.cell_size = cell_size;
  const Eigen::AlignedBox3d box = bounding_box(surface.vertices);
  // Off the round numbers on which drawn surfaces like to lie.
  lattice.origin = box.min() - Vec3(0.47, 0.53, 0.51) * cell_size;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<Index>(axis);
    lattice.size[axis] = static_cast<Index>(std::floor((box.max()[a] - lattice.origin[a]) / cell_size)) + 2;
  }
  add_cells(filled_shares(lattice, surface), lattice);
  return lattice;
}

Real filled_volume(const Lattice& lattice, const Cell& cell) {
  Real share = 0;
  for (std::size_t t = 0; t < 5; ++t) share += cell.fills[t] * cube_cut(cell.parity).shares[t];
  return share * lattice.cell_volume();
}

Real filled_volume_ratio(const Lattice& lattice, const Points& nodes) {
  Real rest = 0, now = 0;
  for_each_volume_ratio(lattice, nodes, [&](const Cell& cell, std::size_t t, Real ratio) {
    const Real filled = cell.fills[t] * cube_cut(cell.parity).shares[t];
    rest += filled;
    now += filled * ratio;
  });
  return rest > 0 ? now / rest : 1;
}

EmbeddedPoint embed(const Lattice& lattice, const Vec3& p) {
  const std::array<Index, 3> place = place_at(lattice, p);
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (place[axis] < 0 || place[axis] >= lattice.size[axis]) return {};
  const auto found = lattice.cell_at.find(number_of(lattice, place));
  if (found == lattice.cell_at.end()) return {};
  const Cell& cell = lattice.cells[static_cast<std::size_t>(found->second)];
  const CubeCut& cut = cube_cut(cell.parity);
  const Vec3 in_cell = (p - lattice.origin) / lattice.cell_size - Vec3(place[0], place[1], place[2]);
  const auto [t, weights] = locate(cut, in_cell);
  EmbeddedPoint point{found->second, {}, weights};
  for (std::size_t k = 0; k < 4; ++k) point.nodes[k] = cell.nodes[static_cast<std::size_t>(cut.tetrahedra[t][k])];
  return point;
}

}  // namespace gracilis::tissue
