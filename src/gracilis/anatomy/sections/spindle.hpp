#pragma once

#include <gracilis/core/types.hpp>

namespace gracilis {

/// What a muscle's size follows from where no surface of it is known.
struct MuscleSize {
  Real max_isometric_force = 0;   ///< N
  Real optimal_fiber = 0;         ///< m
  Real pennation = 0;             ///< rad, at the optimal fiber length
  Real specific_tension = 6.1e5;  ///< N/m², force per physiological cross-section (Arnold et al. 2010)
  Real tendon_stress = 3.2e7;     ///< N/m², in a tendon at the largest force (Zajac 1989)
};

/// Volume of the muscle without its tendon, m³: \f$(F / \sigma) l / \cos\alpha\f$, σ the specific tension, α pennation.
Real muscle_volume(const MuscleSize& size);

/// Radius of the tendon, m.
Real tendon_radius(const MuscleSize& size);

/// Radii (m) of sections whose centers are `positions` (m, ascending) along the action line. The last `tendon` of it is
/// tendon, and the first `origin_tendon`; between them the belly swells and shrinks as a sine from the tendon's radius
/// and back, so far that it has the muscle's volume between the sections. A belly too short for that is no thicker than
/// half its length.
Eigen::VectorXd spindle_radii(const MuscleSize& size, const Eigen::VectorXd& positions, Real tendon,
                              Real origin_tendon = 0);

}  // namespace gracilis
