#pragma once

#include <gracilis/dynamics/constraints/sliver_groups.hpp>
#include <gracilis/dynamics/particles.hpp>

#include <vector>

namespace gracilis {

/// The tip of a triangle so flat that distances and angles do not keep it from turning over, held where it was at rest
/// beside the opposite side a b: at a + share (b - a) + offset, the offset in a frame of the side and the surface's
/// normal there.
struct SliverTip {
  Index particle = 0, a = 0, b = 0;
  float share = 0;
  Eigen::Vector3f offset = Eigen::Vector3f::Zero();  ///< m, along the side, across it in the surface, out of it
  Index begin = 0, end = 0;                          ///< the faces that tell the normal
};

/// All of a surface, the flattest last, so that nothing moves them afterwards.
struct SliverSet {
  std::vector<SliverTip> tips;
  std::vector<Eigen::Vector3i> faces;
  std::vector<SliverGroup> groups;
};

/// How far the tip has to be from its side in the direction where it was at rest, m: half as far as there.
float least_ahead(const SliverTip& tip);

/// Tips that are nearer to the opposite, longest side than `flattest` times its length, or than `flattest` times the
/// mean of all sides. Those that cannot move because all three are fixed are left out.
SliverSet build_sliver_set(const Eigen::Matrix3Xi& faces, const Particles& rest, float flattest);

/// Puts a tip back beside its side. The tip alone moves, because slivers lie beside slivers, and to move a side
/// that others share tears their shortest sides apart; only where the tip is fixed does the side come to it.
void project_sliver(const SliverSet& set, const SliverTip& tip, Particles& particles);

/// All of them, in order.
void project_slivers(const SliverSet& set, Particles& particles);

}  // namespace gracilis
