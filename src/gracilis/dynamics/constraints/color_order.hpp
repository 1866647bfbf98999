#pragma once

#include <gracilis/core/aligned.hpp>
#include <gracilis/dynamics/coloring.hpp>
#include <gracilis/dynamics/simd/group_width.hpp>

#include <vector>

namespace gracilis {

/// Slots of one color: [begin, end), multiples of group_width: every color is padded to whole groups with constraints
/// between copies of an idle particle, which has no mass to move.
struct ColorRange {
  Index begin = 0, end = 0;
};

/// In which order constraints are taken: the colors one after the other, which any number of threads may shorten.
/// Colors [clusters[i], clusters[i + 1]) belong to cluster i, whose particles no other cluster touches, so that
/// clusters run side by side, each within a cache; what lies across clusters comes after the last of them, color by
/// color.
struct ColorOrder {
  std::vector<ColorRange> colors;
  std::vector<Index> clusters = {0};

  Index cluster_count() const { return static_cast<Index>(clusters.size()) - 1; }  ///< of those that run side by side
};

/// Where constraints stand in the tables of their kind.
struct ConstraintLayout {
  ColorOrder order;
  std::vector<Index> slot;    ///< of each constraint
  AlignedVector<Index> idle;  ///< per slot of the tables, padding included: the idle particle that may stand there
};

/// Clusters, colors, groups and pads constraints. Neighbors should have near numbers (particle_order.hpp): clusters are
/// ranges of numbers.
ConstraintLayout lay_out(const ConstraintGraph& graph);

}  // namespace gracilis
