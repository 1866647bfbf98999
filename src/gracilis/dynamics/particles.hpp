#pragma once

#include <gracilis/core/aligned.hpp>
#include <gracilis/core/types.hpp>

#include <vector>

namespace gracilis {

/// Particles as the solver sees them: x, y, z (m, relative to a nearby origin so that float keeps its digits) and the
/// inverse mass (1/kg, 0 for fixed ones) side by side. Idle particles after those that count pad the constraint tables:
/// one for each cluster (particle_order.hpp), so that no two threads ever write to the same one.
struct Particles {
  AlignedVector<float> xyzw;  ///< 4 (n + idle_count)
  Index idle_count = 1;

  Index count() const { return static_cast<Index>(xyzw.size() / 4) - idle_count; }  ///< without idle ones
  float* at(Index i) { return xyzw.data() + 4 * static_cast<std::size_t>(i); }  ///< x, y, z (m), inverse mass (1/kg)
  const float* at(Index i) const { return xyzw.data() + 4 * static_cast<std::size_t>(i); }      ///< the same
  Eigen::Map<Eigen::Vector3f> position(Index i) { return Eigen::Map<Eigen::Vector3f>(at(i)); }  ///< m from the origin
  /// Where a particle is, m from the origin.
  Eigen::Map<const Eigen::Vector3f> position(Index i) const { return Eigen::Map<const Eigen::Vector3f>(at(i)); }
  float inverse_mass(Index i) const { return at(i)[3]; }  ///< 1/kg; 0 of fixed ones
};

/// Particles at `positions` (m, relative to the chosen origin) with `inverse_masses` (1/kg).
Particles make_particles(const Points& positions, const Eigen::VectorXd& inverse_masses);

/// Where all but the idle ones are, m from the origin.
Eigen::Matrix3Xf positions_of(const Particles& particles);

/// Length of the longest way that a particle went from one state to another of as many particles, m.
float largest_motion(const Particles& from, const Particles& to);

/// True when every coordinate is finite.
bool is_finite(const Particles& particles);

}  // namespace gracilis
