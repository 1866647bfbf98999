#pragma once

#include <algorithm>

namespace gracilis {

/// How far a particle may go at once, over what a constraint's value lacks.
constexpr float most_leverage = 2;

/// What the lack of a constraint is divided by, from its effective inverse mass Σ s² w and the largest s w of its
/// particles, s their shares in its gradient and w their inverse masses. A particle whose share is small beside ones
/// that cannot move would otherwise go as much further as its share is smaller, and be thrown to and fro.
inline float limit_leverage(float effective_inverse_mass, float largest) {
  return std::max(effective_inverse_mass, largest / most_leverage);
}

}  // namespace gracilis
