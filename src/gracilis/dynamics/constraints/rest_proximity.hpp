#pragma once

#include <gracilis/dynamics/particles.hpp>

#include <array>
#include <vector>

namespace gracilis {

/// Two parts of one surface so near each other at rest, often by an accident of the data, that contact between parts
/// that come from afar cannot tell what is on which side: a particle and a face (three corners) or two edges. They stay
/// on the side where they were.
struct RestProximity {
  std::array<Index, 2> probe{-1, -1};       ///< a particle, or the ends of an edge
  std::array<Index, 3> target{-1, -1, -1};  ///< the corners of a face, or the ends of an edge
  float side = 1;                           ///< of the target's normal at rest; for edges of probe × target
  float gap = 0;                            ///< m, kept while one is over the other
};

/// All places of a surface in which no distance is above `reach` (m). `vertices` in double, because some of these
/// distances are below what float can tell. Those that cannot move are left out.
std::vector<RestProximity> find_rest_proximities(const Points& vertices, const Eigen::Matrix3Xi& faces, Real reach,
                                                 const Particles& rest);

/// Pushes apart what came nearer than the gap, each by its inverse mass. Returns how many did.
Index project_rest_proximities(const std::vector<RestProximity>& places, Particles& particles);

}  // namespace gracilis
