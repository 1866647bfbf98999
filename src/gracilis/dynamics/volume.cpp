#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/projection.hpp>

namespace gracilis {

namespace {

constexpr Index chunk = 2048;

/// Sums over one chunk of vertices; chunks are added in order, so the result does not depend on threads.
struct Partial {
  double volume = 0, weighted_gradient2 = 0;
};

/// 6 ∂V/∂x_v = Σ over the ring (x_i - x_v) × (x_{i+1} - x_v), and V = Σ_v x_v·∂V/∂x_v / 3.
Partial gather_gradients(const VolumeSet& set, const Particles& particles, Index begin, Index end, float* gradients) {
  Partial partial;
  for (Index v = begin; v < end; ++v) {
    const auto at = static_cast<std::size_t>(v);
    const Eigen::Vector3f x = particles.position(v);
    const Index first = set.ring_offsets[at], last = set.ring_offsets[at + 1];
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    if (first < last) {
      Eigen::Vector3f previous = particles.position(set.ring[static_cast<std::size_t>(last) - 1]) - x;
      for (Index i = first; i < last; ++i) {
        const Eigen::Vector3f next = particles.position(set.ring[static_cast<std::size_t>(i)]) - x;
        sum += previous.cross(next);
        previous = next;
      }
    }
    const Eigen::Vector3f gradient = sum / 6;
    Eigen::Map<Eigen::Vector3f>(gradients + 3 * at) = gradient;
    partial.volume += static_cast<double>(x.dot(gradient)) / 3;
    partial.weighted_gradient2 += static_cast<double>(particles.inverse_mass(v) * gradient.squaredNorm());
  }
  return partial;
}

}  // namespace

double project_volume(const VolumeSet& set, double time_step, double pressure, double& lambda,
                      AlignedVector<float>& gradients, Particles& particles) {
  const Index count = particles.count();
  gradients.resize(3 * static_cast<std::size_t>(count));
  std::vector<Partial> partials(static_cast<std::size_t>((count + chunk - 1) / chunk));
  parallel_for(count, chunk, [&](Index begin, Index end) {
    for (Index from = begin; from < end; from += chunk)
      partials[static_cast<std::size_t>(from / chunk)] =
          gather_gradients(set, particles, from, std::min(from + chunk, end), gradients.data());
  });
  Partial sum;
  for (const Partial& partial : partials) {
    sum.volume += partial.volume;
    sum.weighted_gradient2 += partial.weighted_gradient2;
  }
  const double alpha = set.compliance / (time_step * time_step);
  const double denominator = sum.weighted_gradient2 + alpha;
  if (!(denominator > 0)) return sum.volume;
  const double step = (-(sum.volume - pressure * set.target) - alpha * lambda) / denominator;
  lambda += step;
  parallel_for(count, chunk, [&](Index begin, Index end) {
    for (Index v = begin; v < end; ++v) {
      const float move = particles.inverse_mass(v) * static_cast<float>(step);
      particles.position(v) +=
          move * Eigen::Map<const Eigen::Vector3f>(gradients.data() + 3 * static_cast<std::size_t>(v));
    }
  });
  return sum.volume;
}

}  // namespace gracilis
