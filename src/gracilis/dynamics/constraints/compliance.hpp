#pragma once

#include <gracilis/core/types.hpp>

#include <algorithm>

namespace gracilis {

/// The compliance of a constraint with a stiffness of at least 0. That of none is not infinite, for infinity times a
/// multiplier of 0 is no number, but so large that the constraint moves nothing in single precision.
inline Real compliance_of(Real stiffness) {
  constexpr Real softest = 1e-20;
  return 1 / std::max(stiffness, softest);
}

}  // namespace gracilis
