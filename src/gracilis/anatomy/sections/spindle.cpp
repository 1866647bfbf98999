#include <gracilis/anatomy/sections/spindle.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

Real muscle_volume(const MuscleSize& size) {
  return size.max_isometric_force / size.specific_tension * size.optimal_fiber / std::cos(size.pennation);
}

Real tendon_radius(const MuscleSize& size) { return std::sqrt(size.max_isometric_force / size.tendon_stress / pi); }

/// Volume of a round body with these radii at these places, frustum by frustum.
static Real volume_of(const Eigen::VectorXd& positions, const Eigen::VectorXd& radii, Real begin, Real end) {
  Real volume = 0;
  for (Eigen::Index i = 1; i < positions.size() && positions[i] <= end + 1e-12; ++i) {
    if (positions[i - 1] < begin - 1e-12) continue;
    const Real a = radii[i - 1], b = radii[i];
    volume += pi / 3 * (positions[i] - positions[i - 1]) * (a * a + a * b + b * b);
  }
  return volume;
}

Eigen::VectorXd spindle_radii(const MuscleSize& size, const Eigen::VectorXd& positions, Real tendon,
                              Real origin_tendon) {
  const Real thin = tendon_radius(size), first = positions[0], end = positions[positions.size() - 1];
  // A fifth of the line at least is belly.
  const Real share = std::min(1.0, 0.8 * (end - first) / std::max(tendon + origin_tendon, 1e-9));
  const Real begin = first + share * origin_tendon, belly_end = end - share * tendon;
  const auto radii_for = [&](Real swelling) -> Eigen::VectorXd {
    Eigen::VectorXd radii(positions.size());
    for (Eigen::Index i = 0; i < radii.size(); ++i) {
      const Real along = std::clamp((positions[i] - begin) / (belly_end - begin), 0.0, 1.0);
      radii[i] = thin + swelling * std::sin(pi * along);
    }
    return radii;
  };
  // The volume grows with the swelling: bisection.
  Real low = 0, high = 0.5 * (belly_end - begin);
  const Real wanted = muscle_volume(size);
  for (int i = 0; i < 60; ++i) {
    const Real middle = (low + high) / 2;
    (volume_of(positions, radii_for(middle), begin, belly_end) < wanted ? low : high) = middle;
  }
  return radii_for(low);
}

}  // namespace gracilis
