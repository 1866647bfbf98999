#include <gracilis/dynamics/particles.hpp>

#include <gracilis/dynamics/particle_order.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

Particles make_particles(const Points& positions, const Eigen::VectorXd& inverse_masses) {
  Particles particles;
  particles.idle_count = cluster_count_of(static_cast<Index>(positions.cols()));
  particles.xyzw.assign(4 * static_cast<std::size_t>(static_cast<Index>(positions.cols()) + particles.idle_count), 0);
  for (Index i = 0; i < positions.cols(); ++i) {
    particles.position(i) = positions.col(i).cast<float>();
    particles.at(i)[3] = static_cast<float>(inverse_masses[i]);
  }
  return particles;
}

Eigen::Matrix3Xf positions_of(const Particles& particles) {
  Eigen::Matrix3Xf positions(3, particles.count());
  for (Index i = 0; i < particles.count(); ++i) positions.col(i) = particles.position(i);
  return positions;
}

float largest_motion(const Particles& from, const Particles& to) {
  float largest2 = 0;
  for (Index i = 0; i < to.count(); ++i)
    largest2 = std::max(largest2, (to.position(i) - from.position(i)).squaredNorm());
  return std::sqrt(largest2);
}

bool is_finite(const Particles& particles) {
  return std::all_of(particles.xyzw.begin(), particles.xyzw.end(), [](float value) { return std::isfinite(value); });
}

}  // namespace gracilis
