#include <gracilis/methods/tissue/cell_lanes.hpp>

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gracilis/methods/tissue/cell_lanes.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway asks.
#include <gracilis/methods/tissue/material_lanes-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

using tissue::CellLanes;
using tissue::cells_in_group;
using tissue::CornerForces;
using tissue::CubeCut;
using tissue::LawLanes;

/// Some lanes of one group.
class CellGroup {
 public:
  CellGroup(const CellLanes& cells, const LawLanes& laws, Index group, std::size_t lane)
      : cells_(cells),
        cut_(tissue::cube_cut(cells.parities[static_cast<std::size_t>(group)])),
        per_metre_(1 / cells.cell_size),
        group_(static_cast<std::size_t>(group)),
        lane_(lane),
        law_(load_law(laws, group_ * width + lane)) {}

  /// Whether no tetrahedron counts as inverted. Adds to `energy`.
  HWY_INLINE bool add(const Real* nodes, const LawLanes& laws, CornerForces& forces, N& energy) const {
    std::array<Vectors, 8> corners;
    for (std::size_t c = 0; c < 8; ++c) corners[c] = load_corner(nodes, c);
    std::array<Deformation, 5> deformations;
    N mean = number(0);
    const N least = number(laws.least_volume_ratio);
    auto is_positive = hn::Eq(mean, mean);
    for (std::size_t t = 0; t < 5; ++t) {
      deformations[t] = deformation_of(gradient_of(t, corners));
      mean = hn::MulAdd(share(t), deformations[t].volume_ratio, mean);
      is_positive = hn::And(is_positive, hn::Gt(deformations[t].volume_ratio, least));
    }
    if (!hn::AllTrue(Doubles(), is_positive)) return false;
    N volume = number(0);
    for (std::size_t t = 0; t < 5; ++t) volume = volume + tetrahedron_volume(t);
    const N growth = mean - number(1), inner = volume * number(laws.pressure);
    const N resisting = volume * law_.bulk * growth, pressure = resisting - inner;
    energy = hn::MulAdd(hn::MulSub(number(0.5), resisting, inner), growth, energy);
    std::array<Vectors, 8> sums;
    sums.fill({number(0), number(0), number(0)});
    for (std::size_t t = 0; t < 5; ++t) {
      MatrixLanes stress;
      const N weight = tetrahedron_volume(t);
      energy = hn::MulAdd(weight, tissue_energy_lanes(law_, deformations[t], laws.any_active, stress), energy);
      const MatrixLanes force = plus_scaled(scaled(weight, stress), pressure * share(t), deformations[t].cofactors);
      push(t, force, sums);
    }
    for (std::size_t c = 0; c < 8; ++c) store_corner(sums[c], c, forces);
    return true;
  }

 private:
  static constexpr auto width = static_cast<std::size_t>(cells_in_group);

  std::size_t at(std::size_t count, std::size_t t) const { return (group_ * count + t) * width + lane_; }
  HWY_INLINE N share(std::size_t t) const { return hn::LoadU(Doubles(), &cells_.shares[at(5, t)]); }
  HWY_INLINE N tetrahedron_volume(std::size_t t) const { return hn::LoadU(Doubles(), &cells_.volumes[at(5, t)]); }

  HWY_INLINE Vectors load_corner(const Real* nodes, std::size_t c) const {
    const Doubles d;
    const auto where = hn::LoadU(hn::RebindToSigned<Doubles>(), &cells_.corners[at(8, c)]);
    return {hn::GatherIndex(d, nodes, where), hn::GatherIndex(d, nodes + 1, where),
            hn::GatherIndex(d, nodes + 2, where)};
  }
  HWY_INLINE void store_corner(Vectors sum, std::size_t c, CornerForces& forces) const {
    const Doubles d;
    hn::StoreU(sum.x, d, &forces[0][at(8, c)]);
    hn::StoreU(sum.y, d, &forces[1][at(8, c)]);
    hn::StoreU(sum.z, d, &forces[2][at(8, c)]);
  }

  HWY_INLINE N shape_gradient(std::size_t t, Index axis, std::size_t k) const {
    return number(cut_.shape_gradients[t](axis, static_cast<Index>(k)) * per_metre_);
  }
  /// Gradients of a tetrahedron's corners sum to zero, so its first corner is seen from.
  HWY_INLINE MatrixLanes gradient_of(std::size_t t, const std::array<Vectors, 8>& corners) const {
    const auto& tetrahedron = cut_.tetrahedra[t];
    const auto corner = [&](std::size_t k) HWY_ATTR { return corners[static_cast<std::size_t>(tetrahedron[k])]; };
    const Vectors first = corner(0), a = corner(1) - first, b = corner(2) - first, c = corner(3) - first;
    MatrixLanes f;
    for (Index axis = 0; axis < 3; ++axis) {
      const N by_a = shape_gradient(t, axis, 1), by_b = shape_gradient(t, axis, 2), by_c = shape_gradient(t, axis, 3);
      f.column[axis] = {hn::MulAdd(by_a, a.x, hn::MulAdd(by_b, b.x, by_c * c.x)),
                        hn::MulAdd(by_a, a.y, hn::MulAdd(by_b, b.y, by_c * c.y)),
                        hn::MulAdd(by_a, a.z, hn::MulAdd(by_b, b.z, by_c * c.z))};
    }
    return f;
  }
  HWY_INLINE void push(std::size_t t, const MatrixLanes& force, std::array<Vectors, 8>& sums) const {
    Vectors others = {number(0), number(0), number(0)};
    for (std::size_t k = 1; k < 4; ++k) {
      Vectors here = scaled(shape_gradient(t, 0, k), force.column[0]);
      for (Index axis = 1; axis < 3; ++axis) here = plus_scaled(here, shape_gradient(t, axis, k), force.column[axis]);
      Vectors& sum = sums[static_cast<std::size_t>(cut_.tetrahedra[t][k])];
      sum = sum + here;
      others = others + here;
    }
    Vectors& first = sums[static_cast<std::size_t>(cut_.tetrahedra[t][0])];
    first = first - others;
  }

  const CellLanes& cells_;
  const CubeCut& cut_;
  Real per_metre_;
  std::size_t group_, lane_;
  LawOfLanes law_;
};

Real cell_lane_energy(const CellLanes& cells, const LawLanes& laws, Index begin_group, Index end_group,
                      const Real* nodes, CornerForces& forces) {
  const Doubles d;
  N energy = hn::Zero(d);
  for (Index group = begin_group; group < end_group; ++group)
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(cells_in_group); lane += hn::Lanes(d))
      if (!CellGroup(cells, laws, group, lane).add(nodes, laws, forces, energy))
        return std::numeric_limits<Real>::infinity();
  return hn::GetLane(hn::SumOfLanes(d, energy));
}

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gracilis {

HWY_EXPORT(cell_lane_energy);

namespace tissue {

namespace {

void add_group(const Lattice& lattice, const std::vector<Index>& cells, CellLanes& lanes) {
  const std::size_t begin = lanes.cells.size();
  const auto width = static_cast<std::size_t>(cells_in_group);
  lanes.parities.push_back(lattice.cells[static_cast<std::size_t>(cells[0])].parity);
  lanes.cells.resize(begin + width, -1);
  lanes.corners.resize(8 * (begin + width));
  lanes.volumes.resize(5 * (begin + width), 0);
  lanes.shares.resize(5 * (begin + width), 0);
  for (std::size_t lane = 0; lane < width; ++lane) {
    const bool is_cell = lane < cells.size();
    const Index c = cells[is_cell ? lane : 0];
    const Cell& cell = lattice.cells[static_cast<std::size_t>(c)];
    for (std::size_t k = 0; k < 8; ++k) lanes.corners[8 * begin + k * width + lane] = 3 * std::int64_t{cell.nodes[k]};
    if (!is_cell) continue;
    lanes.cells[begin + lane] = c;
    lanes.slot[static_cast<std::size_t>(c)] = 8 * begin + lane;
    const CellWeights weights = cell_weights(cube_cut(cell.parity), lattice.cell_size, cell.fills);
    for (std::size_t t = 0; t < 5; ++t) {
      lanes.volumes[5 * begin + t * width + lane] = weights.volumes[t];
      lanes.shares[5 * begin + t * width + lane] = weights.shares[t];
    }
  }
}

}  // namespace

CellLanes cell_lanes(const Lattice& lattice) {
  CellLanes lanes;
  lanes.cell_size = lattice.cell_size;
  lanes.slot.resize(lattice.cells.size());
  std::array<std::vector<Index>, 2> waiting;
  for (Index c = 0; c < lattice.cell_count(); ++c) {
    std::vector<Index>& alike = waiting[static_cast<std::size_t>(lattice.cells[static_cast<std::size_t>(c)].parity)];
    alike.push_back(c);
    if (static_cast<Index>(alike.size()) < cells_in_group) continue;
    add_group(lattice, alike, lanes);
    alike.clear();
  }
  for (const std::vector<Index>& rest : waiting)
    if (!rest.empty()) add_group(lattice, rest, lanes);
  return lanes;
}

LawLanes law_lanes(const CellLanes& cells, const std::vector<CellLaw>& laws) {
  LawLanes lanes;
  for (std::size_t at = 0; at < cells.cells.size(); ++at) {
    const std::size_t first = at - at % static_cast<std::size_t>(cells_in_group);
    const CellLaw& law = laws[static_cast<std::size_t>(cells.cells[cells.cells[at] < 0 ? first : at])];
    const FiberLaw fibers = law.direction.isZero(0) ? law.fibers.scaled(0) : law.fibers;
    lanes.shear.push_back(law.matrix.shear);
    lanes.stiffening.push_back(law.matrix.stiffening);
    lanes.lambda.push_back(law.matrix.lambda);
    lanes.bulk.push_back(law.bulk);
    lanes.rest_tension.push_back(fibers.rest_tension);
    lanes.stiffness.push_back(fibers.stiffness);
    lanes.active.push_back(fibers.active_tension);
    lanes.optimal.push_back(fibers.optimal_stretch);
    lanes.least_strain.push_back(slack_strain(fibers));
    for (std::size_t axis = 0; axis < 3; ++axis)
      lanes.direction[axis].push_back(law.direction[static_cast<Index>(axis)]);
    lanes.any_active |= fibers.active_tension > 0;
  }
  return lanes;
}

Real cell_lane_energy(const CellLanes& cells, const LawLanes& laws, Index begin_group, Index end_group,
                      const Points& nodes, CornerForces& forces) {
  return HWY_DYNAMIC_DISPATCH(cell_lane_energy)(cells, laws, begin_group, end_group, nodes.data(), forces);
}

}  // namespace tissue
}  // namespace gracilis
#endif
