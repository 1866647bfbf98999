#pragma once

#include <gracilis/core/aligned.hpp>
#include <gracilis/dynamics/particles.hpp>
#include <gracilis/dynamics/simd/group_width.hpp>
#include <gracilis/dynamics/vertex_faces.hpp>

#include <array>
#include <vector>

namespace gracilis {

struct SliverSet;

/// Slivers that are looked at together, one per lane, because none of them moves what another looks at. Most tips are
/// where they should be; asking them one by one is what slivers would take their time with.
struct SliverGroup {
  std::vector<Index> members;                ///< numbers of the tips, group_width at most; other lanes repeat the last
  std::array<Index, group_width> tip, a, b;  ///< particles
  alignas(64) std::array<float, group_width> share, across, out,
      least;                                ///< where the tip belongs: how far along the
                                            ///< side, the direction of its offset, and m, how far it goes at least
  AlignedVector<Index> around_a, around_b;  ///< per face, first all lanes' next corners, then all lanes' last ones
};

/// Tips in groups, which give the same in their order as the tips do one after the other. `vertex_faces` are the
/// surface's.
std::vector<SliverGroup> group_slivers(const SliverSet& set, const VertexFaces& vertex_faces, const Particles& rest);

}  // namespace gracilis
