#pragma once

#include <gracilis/core/types.hpp>

namespace gracilis::xpbd {

/// Keeps frames to a rate by a share of the iterations that the settings ask for.
struct Pace {
  Real budget = 0;  ///< ms per frame; 0: no rate is asked for
  Real share = 1;   ///< of the iterations
};

/// No fewer iterations are made than this.
inline constexpr int least_iterations = 4;

/// The iterations of the next substep where `asked` are asked for.
int paced_iterations(const Pace& pace, int asked);

/// Learns from a frame: spends 85 % of the budget, for no two frames are alike, falling at once and rising slowly.
void see_frame(Pace& pace, Real milliseconds);

}  // namespace gracilis::xpbd
