#pragma once

#include <gracilis/dynamics/constraints/distance.hpp>

#include <vector>

namespace gracilis {

/// Which edges may come to a strain limit: most never do, and looking at all of them costs as much as projecting them.
struct StrainLimitActiveSet {
  float limit = 0;            ///< longest an edge may be, over its length at rest
  AlignedVector<float> from;  ///< m, per slot of distances: an edge of this length may reach the limit in one iteration
  std::vector<char> groups;   ///< per group_width slots; not 0 (active) where one was as long when last projected
};

/// Fits the active set to the edges of a set, with all groups active; does nothing where it is that for this limit
/// already.
void build_active_set(const DistanceSet& set, float limit, StrainLimitActiveSet& active);

/// Leaves no group active, before distances are projected, which activates those that come near the limit.
void deactivate_all(StrainLimitActiveSet& active);

/// Has all groups active until distances are projected again: something else moved the particles.
void activate_all(StrainLimitActiveSet& active);

/// Shortens edges of slots [begin, end), which belong to one color, that are longer than `limit` times their rest
/// length L to that length, without compliance and without multiplier: \f$C = l L - |x_b - x_a| \ge 0\f$, l the limit.
/// Looks only at what is `active`; null: at all. Returns how many were limited.
Index project_strain_limit(const DistanceSet& set, ColorRange range, float limit, Particles& particles,
                           const StrainLimitActiveSet* active = nullptr);

}  // namespace gracilis
