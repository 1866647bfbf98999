#include <gracilis/dynamics/contact/field/field_contact.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/contact/field/field_contact_edges.hpp>
#include <gracilis/dynamics/contact/field/field_contact_guard.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace gracilis {

namespace {

/// A distance exceeds its ceiling only by more than this, m.
constexpr float rounding = 1e-7f;

}  // namespace

Index project_edge_contacts(const FieldContactSet& set, const FieldPlacement& placement, NearField& near,
                            Particles& particles) {
  std::atomic<Index> touching = 0;
  const float longest_step = safe_step(*set.field.field) / 2;
  for (const ColorRange& color : near.edges.colors)
    parallel_for(color.end - color.begin, contacts_per_task, [&](Index begin, Index end) {
      touching += project_near_edges(set.field.grid, placement, longest_step, {color.begin + begin, color.begin + end},
                                     near.edges, particles);
    });
  return touching;
}

Index project_middle_contacts(const FieldContactSet& set, const FieldPlacement& placement, NearField& near,
                              Particles& particles) {
  Index touching = 0;
  near.middles.resize(set.middles.size());
  for (std::size_t i = 0; i < set.middles.size(); ++i) {
    const EdgeMiddle& middle = set.middles[i];
    const Eigen::Vector3f q = placement.to_obstacle((particles.position(middle.a) + particles.position(middle.b)) / 2);
    if (!may_reach(near.middles[i], q, 0)) continue;
    const FieldSample at = sample(set.field.grid, q);
    const float slope2 = at.gradient.squaredNorm();
    if (slope2 < least_slope2) continue;  // or out of the grid
    near.middles[i] = {q, at.distance - middle.gap};
    if (!(at.distance < middle.gap)) continue;
    ++touching;
    const float wa = particles.inverse_mass(middle.a), wb = particles.inverse_mass(middle.b);
    const Eigen::Vector3f push =
        placement.rotation.transpose() * at.gradient * (2 * (middle.gap - at.distance) / slope2 / (wa + wb));
    particles.position(middle.a) += wa * push;
    particles.position(middle.b) += wb * push;
  }
  return touching;
}

Index project_face_contacts(const FieldContactSet& set, const FaceSet& faces, const FieldPlacement& placement,
                            NearField& near, Particles& particles) {
  std::atomic<Index> touching = 0;
  for (const ColorRange& color : near.faces.colors)
    parallel_for(color.end - color.begin, contacts_per_task, [&](Index begin, Index end) {
      Index count = 0;
      for (Index i = color.begin + begin; i < color.begin + end; ++i) {
        const auto slot = static_cast<std::size_t>(near.faces.slots[static_cast<std::size_t>(i)]);
        const Eigen::Vector3f where = near.faces.where[static_cast<std::size_t>(i)];
        const float gap = near.faces.gap[static_cast<std::size_t>(i)];
        CachedQuery& seen = near.faces.seen[static_cast<std::size_t>(i)];
        Eigen::Vector3f x = Eigen::Vector3f::Zero();
        float sum = 0;
        for (int k = 0; k < 3; ++k) {
          const Index p = faces.particles[static_cast<std::size_t>(k)][slot];
          x += where[k] * particles.position(p);
          sum += where[k] * where[k] * particles.inverse_mass(p);
        }
        const Eigen::Vector3f q = placement.to_obstacle(x);
        if (!may_reach(seen, q, 0)) continue;
        const FieldSample at = sample(set.field.grid, q);
        const float slope2 = at.gradient.squaredNorm();
        if (slope2 < least_slope2) continue;  // or out of the grid
        seen = {q, at.distance - gap};
        if (!(at.distance < gap) || !(sum > 0)) continue;
        ++count;
        const Eigen::Vector3f push =
            placement.rotation.transpose() * at.gradient * ((gap - at.distance) / slope2 / sum);
        for (int k = 0; k < 3; ++k) {
          const Index p = faces.particles[static_cast<std::size_t>(k)][slot];
          particles.position(p) += particles.inverse_mass(p) * where[k] * push;
        }
      }
      touching += count;
    });
  return touching;
}

Index project_particle_contacts(const FieldContactSet& set, const FieldPlacement& placement, NearField& near,
                                Particles& particles) {
  std::atomic<Index> touching = 0;
  const auto cell = static_cast<float>(set.field.field->cell_size.maxCoeff());
  parallel_for(static_cast<Index>(near.particles.size()), contacts_per_task, [&](Index begin, Index end) {
    Index count = 0;
    for (Index i = begin; i < end; ++i) {
      const Index particle = near.particles[static_cast<std::size_t>(i)];
      const auto p = static_cast<std::size_t>(particle);
      const float gap = near.gap[p];
      const Eigen::Vector3f moved = placement.to_obstacle(particles.position(particle));
      const float ceiling = set.ceiling.empty() ? std::numeric_limits<float>::infinity() : set.ceiling[p];
      if (ceiling == std::numeric_limits<float>::infinity() && !may_reach(near.last[p], moved, gap + cell)) continue;
      Eigen::Vector3f q = guarded(set, near.last[p], moved, gap);
      const FieldSample at = sample_bounded(set.field, q);
      const float slope2 = at.gradient.squaredNorm();
      const float wanted = at.distance < gap ? gap : at.distance > ceiling + rounding ? ceiling : at.distance;
      const bool pushed = wanted != at.distance && slope2 > least_slope2;
      if (pushed) q += at.gradient * ((wanted - at.distance) / slope2);
      near.last[p] = {q, pushed ? wanted : at.distance};
      if (q == moved) continue;
      ++count;
      particles.position(particle) += placement.rotation.transpose() * (q - moved);
    }
    touching += count;
  });
  return touching;
}

}  // namespace gracilis
