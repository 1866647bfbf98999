#pragma once

#include <gracilis/core/types.hpp>

namespace gracilis {

/// What the projections of one substep share. XPBD (Macklin, Müller, Chentanez 2016) moves each constraint's multiplier
/// by
///   Δλ = (-C - α̃ λ - γ ∇C·(x - xⁿ)) / ((1 + γ) ∇C w ∇Cᵀ + α̃),  α̃ = α/dt²,  γ = α̃ β̃/dt,  β̃ = dt² β
/// and the particles by w ∇Cᵀ Δλ, w the inverse masses and xⁿ the substep's start.
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
