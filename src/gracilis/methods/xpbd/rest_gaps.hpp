#pragma once

#include <gracilis/anatomy/overlap/overlap_sides.hpp>
#include <gracilis/dynamics/contact/surface/contact_world.hpp>
#include <gracilis/dynamics/contact/surface/surface_ties.hpp>

#include <map>
#include <utility>
#include <vector>

namespace gracilis::xpbd {

/// The muscles that overlap at rest, and what contact makes of that.
class OverlapTable {
 public:
  /// `meshes` are the muscles at rest, in particle order (m); `in_tendon` says of those about lines which particles
  /// belong to tendons.
  OverlapTable(const std::vector<TriangleMesh>& meshes, const std::vector<std::vector<char>>& in_tendon);

  /// m; 0 where they do not overlap.
  Real deepest(Index first, Index second) const;
  /// Notes which particles of the muscles at `rest` overlap, how deep, and how fast they come out. Those that have no
  /// side to come out on stay as deep as they are where one muscle passes through the other or their region is deeper
  /// than `reach`, m; elsewhere they are not kept out, for where thin overlaps stay among others that are released,
  /// surfaces fold.
  void mark(float reach, const std::vector<const Particles*>& rest, SurfacePair& pair) const;

 private:
  struct Entry {
    RestOverlap overlap;
    OverlapSides sides;
  };
  const Entry* find(Index first, Index second) const;
  std::map<std::pair<Index, Index>, Entry> entries_;
};

/// Lowers the gaps of a pair, which are the margin, to what there is at rest, but for what overlaps there: that is
/// released. Around attachments that overlap attachments of the other, and around ends that are tied to it, the release
/// fades, for those stay. `state` has what was found at `rest`.
void measure_rest_gaps(const ContactWorldState& state, const std::vector<const Particles*>& rest, std::size_t pair,
                       const std::vector<TiedSurfaces>& ties, ContactWorld& world);

}  // namespace gracilis::xpbd
