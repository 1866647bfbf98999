#include <gracilis/dynamics/field_contact.hpp>

#include <gracilis/core/parallel.hpp>

#include <atomic>

namespace gracilis {

namespace {

constexpr Index chunk = 512;

struct Push {
  float depth = 0;  ///< how far below the gap; 0: not touching
  Eigen::Vector3f direction;
};

/// How far, and in the particles' frame where to, the point must move to stand at `gap`.
Push push_out(const FieldContactSet& set, const FieldPlacement& placement, const Eigen::Vector3f& x, float gap) {
  const FieldSample answer = sample(*set.field, Eigen::Vector3f(placement.rotation * x + placement.translation));
  if (!(answer.distance < gap)) return {};
  const float slope2 = answer.gradient.squaredNorm();
  // On the field's ridges the interpolated gradient fades; there is no way out to be read from it.
  if (slope2 < 1e-4f) return {};
  return {(gap - answer.distance) / std::sqrt(slope2),
          placement.rotation.transpose() * (answer.gradient / std::sqrt(slope2))};
}

Eigen::Vector3f midpoint(const DistanceSet& distances, Index slot, const Particles& particles) {
  const auto at = static_cast<std::size_t>(slot);
  return (particles.position(distances.a[at]) + particles.position(distances.b[at])) / 2;
}

}  // namespace

void find_near(const FieldContactSet& set, const DistanceSet& distances, const FieldPlacement& placement,
               const Particles& particles, float reach, NearField& near) {
  near.particles.clear();
  near.edges.clear();
  near.edge_colors.clear();
  std::vector<char> is_near(static_cast<std::size_t>(particles.count()) + 1, 0);
  parallel_for(particles.count(), chunk, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      const Eigen::Vector3f q = placement.rotation * particles.position(i) + placement.translation;
      is_near[static_cast<std::size_t>(i)] =
          sample(*set.field, q).distance < set.particle_gap[static_cast<std::size_t>(i)] + reach;
    }
  });
  for (Index i = 0; i < particles.count(); ++i)
    if (is_near[static_cast<std::size_t>(i)] && particles.inverse_mass(i) > 0) near.particles.push_back(i);
  if (set.edge_gap.empty()) return;
  for (const ColorRange& color : distances.colors) {
    const auto begin = static_cast<Index>(near.edges.size());
    for (Index slot = color.begin; slot < color.end; ++slot) {
      const Index a = distances.a[static_cast<std::size_t>(slot)], b = distances.b[static_cast<std::size_t>(slot)];
      const bool movable = particles.inverse_mass(a) + particles.inverse_mass(b) > 0;
      if (movable && (is_near[static_cast<std::size_t>(a)] || is_near[static_cast<std::size_t>(b)]))
        near.edges.push_back(slot);
    }
    near.edge_colors.push_back({begin, static_cast<Index>(near.edges.size())});
  }
}

Index project_edge_contacts(const FieldContactSet& set, const DistanceSet& distances, const FieldPlacement& placement,
                            const NearField& near, Particles& particles) {
  std::atomic<Index> touching = 0;
  for (const ColorRange& color : near.edge_colors)
    parallel_for(color.end - color.begin, chunk, [&](Index begin, Index end) {
      Index count = 0;
      for (Index i = color.begin + begin; i < color.begin + end; ++i) {
        const Index slot = near.edges[static_cast<std::size_t>(i)];
        const Push push = push_out(set, placement, midpoint(distances, slot, particles),
                                   set.edge_gap[static_cast<std::size_t>(slot)]);
        if (push.depth <= 0) continue;
        ++count;
        const Index a = distances.a[static_cast<std::size_t>(slot)], b = distances.b[static_cast<std::size_t>(slot)];
        const float wa = particles.inverse_mass(a), wb = particles.inverse_mass(b);
        const float scale = 2 * push.depth / (wa + wb);
        particles.position(a) += wa * scale * push.direction;
        particles.position(b) += wb * scale * push.direction;
      }
      touching += count;
    });
  return touching;
}

Index project_particle_contacts(const FieldContactSet& set, const FieldPlacement& placement, const NearField& near,
                                Particles& particles) {
  std::atomic<Index> touching = 0;
  parallel_for(static_cast<Index>(near.particles.size()), chunk, [&](Index begin, Index end) {
    Index count = 0;
    for (Index i = begin; i < end; ++i) {
      const Index particle = near.particles[static_cast<std::size_t>(i)];
      const Push push =
          push_out(set, placement, particles.position(particle), set.particle_gap[static_cast<std::size_t>(particle)]);
      if (push.depth <= 0) continue;
      ++count;
      particles.position(particle) += push.depth * push.direction;
    }
    touching += count;
  });
  return touching;
}

}  // namespace gracilis
