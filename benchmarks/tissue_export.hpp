#pragma once

#include <tissue_blocks.hpp>

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace gracilis::tissue {

/// A block of whole cells as text, with what came out of it: all that another finite-element program needs to solve the
/// same (reproductions/tissue_verification/peer.py). A word and its count, then so many lines.
inline void export_block(const std::filesystem::path& folder, const std::string& name, const Block& block,
                         const SettledBlock& settled) {
  const Lattice& lattice = block.muscle.lattice;
  std::ofstream out(folder / (name + ".txt"));
  fmt::print(out, "nodes {}\n", lattice.node_count());
  for (Index n = 0; n < lattice.node_count(); ++n)
    fmt::print(out, "{:.17g} {:.17g} {:.17g}\n", lattice.nodes(0, n), lattice.nodes(1, n), lattice.nodes(2, n));
  fmt::print(out, "tetrahedra {}\n", 5 * lattice.cell_count());  // cell and corners
  for (std::size_t c = 0; c < lattice.cells.size(); ++c)
    for (const auto& corners : cube_cut(lattice.cells[c].parity).tetrahedra) {
      const auto node = [&](std::size_t k) { return lattice.cells[c].nodes[static_cast<std::size_t>(corners[k])]; };
      fmt::print(out, "{} {} {} {} {}\n", c, node(0), node(1), node(2), node(3));
    }
  const CellLaw& law = block.laws.front();
  const FiberLaw& f = law.fibers;
  fmt::print(out, "law 1\n{:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}\n",
             law.matrix.shear, law.matrix.lambda, law.bulk, f.rest_tension, f.stiffness, f.active_tension,
             f.optimal_stretch, law.direction.x(), law.direction.y(), law.direction.z(), law.matrix.stiffening);
  std::vector<std::string> fixed;  // side, node, axis, displacement
  const auto fix = [&](std::size_t side, std::size_t p, Index axis, Real place) {
    const SurfacePoint& point = block.muscle.points[p];
    fixed.push_back(fmt::format("{} {} {} {:.17g}\n", side, point.at.nodes[0], axis, place - point.rest[axis]));
  };
  for (std::size_t s = 0; s < block.sides.size(); ++s)
    for (std::size_t p = block.sides[s].begin; p < block.sides[s].end; ++p)
      if (block.muscle.points[p].held_by >= 0)
        for (Index axis = 0; axis < 3; ++axis) fix(s, p, axis, block.held[p][axis]);
  for (std::size_t i = 0; i < block.planes.size(); i += 2)  // the other one of each pair says the same
    for (Index axis = 0; axis < 3; ++axis)
      if (block.planes[i].normal[axis] == 1)
        fix(static_cast<std::size_t>(block.planes[i].muscle), static_cast<std::size_t>(block.planes[i].point), axis,
            block.planes[i].least);
  fmt::print(out, "fixed {}\n", fixed.size());
  for (const std::string& line : fixed) out << line;
  if (block.bone) fmt::print(out, "bone 1\n{:.17g}\n", block.muscle.settings.contact_stiffness);
  fmt::print(out, "moved {}\n", lattice.node_count());
  for (Index n = 0; n < lattice.node_count(); ++n) {
    const Vec3 moved = settled.nodes.col(n) - lattice.nodes.col(n);
    fmt::print(out, "{:.17g} {:.17g} {:.17g}\n", moved.x(), moved.y(), moved.z());
  }
  fmt::print(out, "forces {}\n", block.sides.size());
  for (std::size_t s = 0; s < block.sides.size(); ++s) {
    const Vec3 force = force_on(block, settled, s);
    fmt::print(out, "{} {:.17g} {:.17g} {:.17g}\n", s, force.x(), force.y(), force.z());
  }
  fmt::print(out, "solved 1\n{:.17g} {} {:.17g}\n", settled.seconds, settled.done.iterations, settled.done.residual);
}

}  // namespace gracilis::tissue
