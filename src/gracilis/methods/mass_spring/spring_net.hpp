#pragma once

#include <gracilis/core/group_by_key.hpp>
#include <gracilis/methods/mass_spring/layout.hpp>

#include <vector>

namespace gracilis::mass_spring {

struct Spring {
  Index a = 0, b = 0;
  Real length = 0;     ///< m, at rest
  Real stiffness = 0;  ///< N/m
};

/// The springs of one muscle; never changes.
struct SpringNet {
  std::vector<Spring> springs;
  GroupedByKey ends;  ///< by particle: its springs, as 2 × spring, + 1 where it is b
};

/// Springs whose rest length is their length in `rest` (3 × n, m), with stiffness = material / rest length (Janák 2012,
/// section 2.3). Not published: a spring shorter than `shortest_share` of the mean is as stiff as that length would
/// make it, since particles that nearly coincide would have springs without bounds; one without length has none.
SpringNet build_spring_net(const Points& rest, const SpringPairs& pairs, Real material, Real shortest_share);

/// The forces on all particles, N: \f$-\sum_j F_{ij}\f$ by eq. 2.7, \f$F_{ij} = k (|l| - |l^0|) l / |l|\f$ with l =
/// x_i - x_j, for springs to restore. A spring without length pulls nowhere. The same bits for any number of threads.
void spring_forces(const SpringNet& net, const Points& points, Points& forces);

/// How far springs are from their lengths at rest, all together, m (section 5.4).
Real length_changes(const SpringNet& net, const Points& points);

/// N/m; 0 without springs.
Real mean_stiffness(const SpringNet& net);

/// A time step (s) within which Verlet's scheme is stable without damping, whatever the springs' directions: it is up
/// to \f$2 \sqrt{m/\lambda}\f$, and no eigenvalue λ is above twice the largest sum of stiffnesses at a particle.
/// Infinite without springs.
Real stable_step(const SpringNet& net, Real mass);

}  // namespace gracilis::mass_spring
