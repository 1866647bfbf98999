#include <gracilis/methods/tissue/cell_lanes.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace gracilis::tissue {
namespace {

/// A box of 5 × 4 × 3 cells, some of them little filled.
Lattice box_lattice() { return build_lattice(shapes::box({0, 0, 0}, {0.0355, 0.0282, 0.0211}), 0.008); }

/// Laws that differ from cell to cell: active, passive, and without fibers.
std::vector<CellLaw> mixed_laws(const Lattice& lattice) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<Real> uniform(0, 1);
  std::vector<CellLaw> laws;
  for (Index c = 0; c < lattice.cell_count(); ++c) {
    CellLaw& law = laws.emplace_back();
    law.matrix = {5e3 * (1 + uniform(generator)), 1e5, uniform(generator)};
    law.bulk = 2e6 * (1 + uniform(generator));
    law.fibers = {2e4, c % 5 == 0 ? 0 : 5e4, c % 3 == 0 ? 0 : 3e5 * uniform(generator), 0.8 + 0.4 * uniform(generator)};
    if (c % 7 != 0) law.direction = Vec3(uniform(generator), -uniform(generator), 1).normalized();
  }
  return laws;
}

struct Expected {
  Real energy = 0;
  Points gradient;
};
Expected by_cells(const Lattice& lattice, const std::vector<CellLaw>& laws, const Points& nodes) {
  Expected sum{0, Points::Zero(3, lattice.node_count())};
  for (std::size_t c = 0; c < laws.size(); ++c) {
    const Cell& cell = lattice.cells[c];
    const CellState state =
        cell_energy(cube_cut(cell.parity), lattice.cell_size, cell.fills, laws[c], corners_of(cell, nodes));
    sum.energy += state.energy;
    for (Index k = 0; k < 8; ++k) sum.gradient.col(cell.nodes[static_cast<std::size_t>(k)]) += state.gradient.col(k);
  }
  return sum;
}

Expected by_lanes(const Lattice& lattice, const std::vector<CellLaw>& laws, const Points& nodes) {
  const CellLanes cells = cell_lanes(lattice);
  CornerForces forces;
  for (std::vector<Real>& axis : forces) axis.resize(cells.corner_count());
  Expected sum{cell_lane_energy(cells, law_lanes(cells, laws), 0, cells.group_count(), nodes, forces),
               Points::Zero(3, lattice.node_count())};
  for (std::size_t corner = 0; corner < cells.corner_count(); ++corner)
    sum.gradient.col(cells.corners[corner] / 3) += Vec3(forces[0][corner], forces[1][corner], forces[2][corner]);
  return sum;
}

void expect_same(const Lattice& lattice, const Points& nodes) {
  const std::vector<CellLaw> laws = mixed_laws(lattice);
  const Expected expected = by_cells(lattice, laws, nodes), found = by_lanes(lattice, laws, nodes);
  ASSERT_TRUE(std::isfinite(expected.energy));
  EXPECT_NEAR(found.energy, expected.energy, 1e-12 * std::abs(expected.energy));
  EXPECT_LT((found.gradient - expected.gradient).norm(), 1e-12 * expected.gradient.norm());
}

Points stirred(const Lattice& lattice, Real size) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<Real> uniform(-size, size);
  Points nodes = lattice.nodes;
  for (Index i = 0; i < static_cast<Index>(nodes.size()); ++i) nodes.data()[i] += uniform(generator);
  return nodes;
}

TEST(TissueLanes, cells_side_by_side_have_the_energy_and_the_forces_of_one_after_the_other) {
  const Lattice lattice = box_lattice();
  expect_same(lattice, stirred(lattice, 5e-4));
}

TEST(TissueLanes, so_they_do_where_fibers_are_slack_or_stretched_beyond_all_active_tension) {
  const Lattice lattice = box_lattice();
  for (const Real stretch : {0.35, 0.5, 0.7, 1.3, 1.5, 1.8}) {
    Points nodes = stirred(lattice, 3e-4);
    nodes.row(2) *= stretch;
    nodes.topRows<2>() /= std::sqrt(stretch);
    expect_same(lattice, nodes);
  }
}

TEST(TissueLanes, so_they_do_where_little_volume_is_left) {
  const Lattice lattice = box_lattice();
  Points nodes = stirred(lattice, 1e-4);
  nodes.row(0) *= 0.2;
  expect_same(lattice, nodes);
}

TEST(TissueLanes, one_inverted_tetrahedron_makes_the_energy_infinite) {
  const Lattice lattice = box_lattice();
  Points nodes = lattice.nodes;
  nodes.col(lattice.node_count() / 2) += Vec3(0.03, 0, 0);
  EXPECT_TRUE(std::isinf(by_lanes(lattice, mixed_laws(lattice), nodes).energy));
}

TEST(TissueLanes, what_is_squeezed_below_the_least_volume_counts_as_inverted) {
  const Lattice lattice = box_lattice();
  const CellLanes cells = cell_lanes(lattice);
  LawLanes laws = law_lanes(cells, mixed_laws(lattice));
  CornerForces forces;
  for (std::vector<Real>& axis : forces) axis.resize(cells.corner_count());
  const Points nodes = 0.4 * lattice.nodes;  // 0.064 of the volume
  for (const Real least : {0.06, 0.07}) {
    laws.least_volume_ratio = least;
    const Real energy = cell_lane_energy(cells, laws, 0, cells.group_count(), nodes, forces);
    EXPECT_EQ(std::isfinite(energy), least < 0.064);
  }
}

TEST(TissueLanes, a_pressure_works_by_the_volume_that_cells_gain_and_its_forces_are_the_derivative_of_that) {
  const Lattice lattice = box_lattice();
  const CellLanes cells = cell_lanes(lattice);
  LawLanes laws = law_lanes(cells, mixed_laws(lattice));
  CornerForces forces, pressed;
  for (CornerForces* each : {&forces, &pressed})
    for (std::vector<Real>& axis : *each) axis.resize(cells.corner_count());
  const Real pressure = 2e4, volume = std::accumulate(cells.volumes.begin(), cells.volumes.end(), Real{0});
  const auto work = [&](const Points& nodes) {
    laws.pressure = 0;
    const Real without = cell_lane_energy(cells, laws, 0, cells.group_count(), nodes, forces);
    laws.pressure = pressure;
    return without - cell_lane_energy(cells, laws, 0, cells.group_count(), nodes, pressed);
  };
  EXPECT_NEAR(work(1.1 * lattice.nodes) / (pressure * volume * (1.331 - 1)), 1, 1e-9);
  EXPECT_NEAR(work(lattice.nodes), 0, 1e-12);
  // Along a motion of the corners the forces lose what the work gains.
  const Points nodes = stirred(lattice, 1e-3), way = stirred(lattice, 1e-3) - lattice.nodes;
  const Real step = 1e-4, gained = (work(nodes + step * way) - work(nodes - step * way)) / (2 * step);
  work(nodes);
  Real lost = 0;
  for (std::size_t corner = 0; corner < cells.corner_count(); ++corner)
    for (std::size_t axis = 0; axis < 3; ++axis)
      lost += (forces[axis][corner] - pressed[axis][corner]) *
              way(static_cast<Index>(axis), static_cast<Index>(cells.corners[corner] / 3));
  EXPECT_NEAR(lost / gained, 1, 1e-6);
}

TEST(TissueLanes, each_cell_stands_in_one_lane_whatever_their_number) {
  for (const Real width : {0.005, 0.012, 0.05}) {
    const Lattice lattice = build_lattice(shapes::box({0, 0, 0}, {width, width, 0.02}), 0.008);
    const CellLanes lanes = cell_lanes(lattice);
    std::vector<int> seen(lattice.cells.size());
    for (std::size_t at = 0; at < lanes.cells.size(); ++at) {
      if (lanes.cells[at] < 0) continue;
      const auto c = static_cast<std::size_t>(lanes.cells[at]);
      ++seen[c];
      EXPECT_EQ(lanes.parities[at / cells_in_group], lattice.cells[c].parity);
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), lattice.cell_count());
  }
}

}  // namespace
}  // namespace gracilis::tissue
