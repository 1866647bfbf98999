#pragma once

#include <gracilis/core/types.hpp>

#include <vector>

namespace gracilis {

/// Constraints of one size over particles: constraint i touches particles[i * arity] ... particles[(i + 1) * arity -
/// 1].
struct ConstraintGraph {
  int arity = 2;
  Index particle_count = 0;
  std::vector<Index> particles;

  Index constraint_count() const { return static_cast<Index>(particles.size()) / arity; }
};

/// Gives every constraint a color such that constraints of one color share no particle: greedy coloring in
/// smallest-last order (Matula and Beck 1983), which needs at most one color more than the graph's degeneracy.
/// Deterministic.
std::vector<Index> color_constraints(const ConstraintGraph& graph);

}  // namespace gracilis
