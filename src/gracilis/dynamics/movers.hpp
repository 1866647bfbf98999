#pragma once

#include <vector>

namespace gracilis {

/// Which of all surfaces move while others stay where they are; an empty list: all.
struct Movers {
  std::vector<char> listed;

  /// Whether that surface moves.
  bool move(std::size_t surface) const { return listed.empty() || listed[surface] != 0; }
};

}  // namespace gracilis
