#pragma once

#include <gracilis/core/types.hpp>

namespace gracilis {

/// What the projections of one substep share. XPBD (Macklin, Müller, Chentanez 2016) moves each multiplier by
/// \f[\Delta\lambda = \frac{-C - a \lambda - \gamma \nabla C \cdot (x - x^n)}{(1 + \gamma) \nabla C w \nabla C^T +
/// a}\f] with \f$a = \alpha/dt^2, \gamma = a b/dt, b = dt^2 \beta\f$, and the particles by \f$w \nabla C^T
/// \Delta\lambda\f$, w the inverse masses and xⁿ the substep's start.
struct ProjectionParameters {
  float time_step = 1.0f / 60;    ///< s
  float rayleigh_beta = 0;        ///< dissipation; 0: the start positions are not read
  float dihedral_limit = 0;       ///< largest motion by one dihedral projection as a share of its edge; 0: none
  bool arccos_dihedrals = false;  ///< the published angle measure
};

/// What one pass did besides moving particles.
struct ProjectionCounts {
  Index limited = 0;  ///< dihedrals held back by the limit
  Index skipped = 0;  ///< constraints without a usable gradient
};

}  // namespace gracilis
