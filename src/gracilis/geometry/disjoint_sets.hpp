#pragma once

#include <gracilis/core/types.hpp>

#include <cstddef>
#include <numeric>
#include <vector>

namespace gracilis {

/// Numbers from 0 to count - 1 in disjoint sets, each alone at first, with path halving.
class DisjointSets {
 public:
  /// So many numbers, each a set of its own.
  explicit DisjointSets(Index count) : parent_(static_cast<std::size_t>(count)) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
  }
  /// The member that stands for the set of i.
  Index find(Index i) {
    while (parent(i) != i) i = parent(i) = parent(parent(i));
    return i;
  }
  /// Makes one set of two; what stood for that of b stands for both.
  void join(Index a, Index b) { parent(find(a)) = find(b); }

 private:
  Index& parent(Index i) { return parent_[static_cast<std::size_t>(i)]; }
  std::vector<Index> parent_;
};

}  // namespace gracilis
