#pragma once

#include <gracilis/core/types.hpp>

namespace gracilis {

/// A muscle's and its tendon's rest length in a model, and in a skeleton of another size (Laclé 2014, eqs. 3.7
/// to 3.10).
struct TendonLengths {
  Real rest = 0;           ///< m, l_ts + l_opt cos α
  Real scaled_rest = 0;    ///< m, scaled with the action line
  Real scaled_tendon = 0;  ///< m, the whole slack length, scaled alike
};

/// From optimal fiber length (m), pennation angle (rad), tendon slack length (m), and the lengths (m) of the action
/// line in the model and in the other skeleton.
TendonLengths tendon_lengths(Real optimal_fiber, Real pennation, Real slack, Real line, Real scaled_line);

}  // namespace gracilis
