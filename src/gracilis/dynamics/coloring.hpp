#pragma once

#include <gracilis/core/types.hpp>

#include <array>
#include <vector>

namespace gracilis {

/// Constraints of one size over particles: constraint i touches particles[i * arity] ... particles[(i + 1) * arity -
/// 1].
struct ConstraintGraph {
  int arity = 2;
  Index particle_count = 0;
  std::vector<Index> particles;

  /// Groups of `arity` particles.
  Index constraint_count() const { return static_cast<Index>(particles.size()) / arity; }
};

/// Gives every constraint a color such that constraints of one color share no particle: greedy coloring in
/// smallest-last order (Matula and Beck 1983), which needs at most one color more than the graph's degeneracy.
/// Deterministic.
std::vector<Index> color_constraints(const ConstraintGraph& graph);

/// Groups pairs of surfaces (a surface may be paired with itself) into rounds in which no surface stands twice, each
/// pair into the first round that is free for it.
std::vector<std::vector<Index>> rounds_of(const std::vector<std::array<Index, 2>>& pairs);

}  // namespace gracilis
