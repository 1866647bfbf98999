#include <gracilis/dynamics/constraints/shape_limit.hpp>

namespace gracilis {

namespace {

Eigen::Vector3f mean_of_neighbors(const ShapeLimitSet& set, Index particle, const Particles& particles) {
  const auto p = static_cast<std::size_t>(particle);
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (Index i = set.stars.offsets[p]; i < set.stars.offsets[p + 1]; ++i)
    sum += particles.position(set.stars.neighbors[static_cast<std::size_t>(i)]);
  return sum / static_cast<float>(set.stars.offsets[p + 1] - set.stars.offsets[p]);
}

bool has_neighbors(const ShapeLimitSet& set, std::size_t p) { return set.stars.offsets[p + 1] > set.stars.offsets[p]; }

/// The farthest that a particle may be from the mean of its neighbors, and from the one that it faces, m.
float farthest_apart(const ShapeLimitSet& set, float spike, std::size_t p) {
  return set.apart[p] + spike * set.reach[p];
}
float thickest(const ShapeLimitSet& set, float thickness, std::size_t p) {
  return thickness * (set.thickness[p] + set.mean_edge) - set.mean_edge;
}
/// The nearest; negative where any distance will do.
float thinnest(const ShapeLimitSet& set, float thinness, std::size_t p) { return thickest(set, 1 / thinness, p); }

/// C(x) = apart - |x - mean|, with the gradients -n for the particle and n / count for each neighbor.
bool push_back_spike(const ShapeLimitSet& set, float spike, Index particle, Particles& particles) {
  const auto p = static_cast<std::size_t>(particle);
  if (!has_neighbors(set, p)) return false;
  const Eigen::Vector3f out = particles.position(particle) - mean_of_neighbors(set, particle, particles);
  const float length = out.norm(), beyond = length - farthest_apart(set, spike, p);
  if (!(beyond > 0)) return false;
  const float share = 1 / static_cast<float>(set.stars.offsets[p + 1] - set.stars.offsets[p]);
  float weight = particles.inverse_mass(particle);
  for (Index i = set.stars.offsets[p]; i < set.stars.offsets[p + 1]; ++i)
    weight += share * share * particles.inverse_mass(set.stars.neighbors[static_cast<std::size_t>(i)]);
  if (!(weight > 0)) return false;
  const Eigen::Vector3f push = (beyond / (weight * length)) * out;
  particles.position(particle) -= particles.inverse_mass(particle) * push;
  for (Index i = set.stars.offsets[p]; i < set.stars.offsets[p + 1]; ++i) {
    const Index neighbor = set.stars.neighbors[static_cast<std::size_t>(i)];
    particles.position(neighbor) += share * particles.inverse_mass(neighbor) * push;
  }
  return true;
}

/// C(x) = ±(bound - |x - x_o|), with the gradients ∓n for the particle and ±n for the one that it faces: brings them to
/// the distance `bound`.
bool bring_to_distance(const ShapeLimitSet& set, Index particle, float bound, Particles& particles) {
  const Index opposite = set.opposite[static_cast<std::size_t>(particle)];
  const Eigen::Vector3f across = particles.position(particle) - particles.position(opposite);
  const float length = across.norm();
  const float weight = particles.inverse_mass(particle) + particles.inverse_mass(opposite);
  if (!(weight > 0) || !(length > 0)) return false;
  const Eigen::Vector3f push = ((length - bound) / (weight * length)) * across;
  particles.position(particle) -= particles.inverse_mass(particle) * push;
  particles.position(opposite) += particles.inverse_mass(opposite) * push;
  return true;
}

float distance_through(const ShapeLimitSet& set, Index particle, const Particles& particles) {
  return (particles.position(particle) - particles.position(set.opposite[static_cast<std::size_t>(particle)])).norm();
}

/// The distance nearest to `distance` that the limits allow between a particle and the one that it faces, m.
float allowed_distance(const ShapeLimitSet& set, const ShapeLimits& limits, std::size_t p, float distance) {
  if (limits.thickness > 0 && distance > thickest(set, limits.thickness, p)) return thickest(set, limits.thickness, p);
  if (limits.thinness > 0 && distance < thinnest(set, limits.thinness, p)) return thinnest(set, limits.thinness, p);
  return distance;
}

/// Brings the two that face each other together where they are too far apart, and apart where they are too near.
bool keep_thickness(const ShapeLimitSet& set, const ShapeLimits& limits, Index particle, Particles& particles) {
  const auto p = static_cast<std::size_t>(particle);
  if (set.opposite[p] < 0) return false;
  const float distance = distance_through(set, particle, particles);
  const float allowed = allowed_distance(set, limits, p, distance);
  return allowed != distance && bring_to_distance(set, particle, allowed, particles);
}

/// Limits that are reached at this share of the way to others.
ShapeLimits at_share(const ShapeLimits& limits, float share) {
  const auto of_ratio = [share](float limit) { return limit > 0 ? 1 + share * (limit - 1) : 0; };
  return {share * limits.spike, of_ratio(limits.thickness), of_ratio(limits.thinness)};
}

}  // namespace

ShapeLimitSet build_shape_limits(const SurfaceShape& rest) {
  const auto in_floats = [](const std::vector<Real>& values) {
    return std::vector<float>(values.begin(), values.end());
  };
  return {rest.stars,
          rest.opposite,
          in_floats(rest.apart),
          in_floats(rest.reach),
          in_floats(rest.thickness),
          static_cast<float>(rest.mean_edge)};
}

std::vector<Index> near_shape_limits(const ShapeLimitSet& set, const ShapeLimits& limits, float share,
                                     const Particles& particles) {
  std::vector<Index> near;
  const ShapeLimits nearer = at_share(limits, share);
  for (Index particle = 0; particle < static_cast<Index>(set.apart.size()); ++particle) {
    const auto p = static_cast<std::size_t>(particle);
    const auto spikes = [&] {
      return nearer.spike > 0 && has_neighbors(set, p) &&
             (particles.position(particle) - mean_of_neighbors(set, particle, particles)).norm() >
                 farthest_apart(set, nearer.spike, p);
    };
    const auto changes_thickness = [&] {
      if (set.opposite[p] < 0) return false;
      const float distance = distance_through(set, particle, particles);
      return allowed_distance(set, nearer, p, distance) != distance;
    };
    if (changes_thickness() || spikes()) near.push_back(particle);
  }
  return near;
}

Index project_shape_limits(const ShapeLimitSet& set, const ShapeLimits& limits, const std::vector<Index>& listed,
                           Particles& particles) {
  Index beyond = 0;
  for (const Index particle : listed) {
    beyond += keep_thickness(set, limits, particle, particles);
    if (limits.spike > 0) beyond += push_back_spike(set, limits.spike, particle, particles);
  }
  return beyond;
}

}  // namespace gracilis
