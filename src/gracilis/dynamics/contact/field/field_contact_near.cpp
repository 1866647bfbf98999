#include <gracilis/dynamics/contact/field/field_contact_near.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/contact/field/field_contact_away.hpp>
#include <gracilis/dynamics/contact/field/field_contact_edges.hpp>
#include <gracilis/dynamics/contact/field/field_contact_guard.hpp>
#include <gracilis/dynamics/contact/field/field_contact_listing.hpp>

#include <cmath>
#include <limits>

namespace gracilis {

namespace {

/// Clearance of every particle, those that are near, and where they are. A particle is asked again only once it may
/// have used up what it was away when last seen.
void see_particles(const FieldContactSet& set, const FieldPlacement& placement, float reach, Particles& particles,
                   NearField& near, std::vector<char>& is_near) {
  const auto count = static_cast<std::size_t>(particles.count()),
             all = count + static_cast<std::size_t>(particles.idle_count);
  const bool known = near.last.size() == count;
  near.last.resize(count);
  near.gap.resize(all, 0);
  near.clearance.resize(all, std::numeric_limits<float>::infinity());
  const auto cell = static_cast<float>(set.field.field->cell_size.maxCoeff());
  parallel_for(particles.count(), contacts_per_task, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      const auto p = static_cast<std::size_t>(i);
      const float gap = blended(set.captured.particle, set.released.particle, p, placement.release);
      const bool bound = !set.ceiling.empty() && std::isfinite(set.ceiling[p]);
      near.gap[p] = gap;
      Eigen::Vector3f q = placement.to_obstacle(particles.position(i));
      if (known && !bound) {
        const float left = near.last[p].distance - steepest * (q - near.last[p].place).norm() - cell - gap;
        near.clearance[p] = left;
        if (left > reach) continue;
      }
      const bool movable = particles.inverse_mass(i) > 0;
      if (known && movable) {
        const Eigen::Vector3f kept = guarded(set, near.last[p], q, gap);
        if (kept != q) particles.position(i) = placement.from_obstacle(kept);
        q = kept;
      }
      const float distance = sample_bounded(set.field, q).distance;
      near.last[p] = {q, distance};
      near.clearance[p] = distance - gap;
      is_near[p] = movable && (bound || distance < gap + reach);
    }
  });
}

}  // namespace

void find_edge_points(const FieldContactSet& set, const FieldPlacement& placement, const Particles& particles,
                      NearField& near) {
  find_deepest_points(set.field.grid, placement, particles, near.edges);
}

void find_near(const FieldContactSet& set, const DistanceSet& distances, const FaceSet& faces,
               const FieldPlacement& placement, float reach, Particles& particles, NearField& near) {
  clear_near(near);
  std::vector<char> is_near(static_cast<std::size_t>(particles.count()), 0);
  see_particles(set, placement, reach, particles, near, is_near);
  near.away = seen_away(set, placement, near);
  for (Index i = 0; i < particles.count(); ++i)
    if (is_near[static_cast<std::size_t>(i)]) near.particles.push_back(i);
  if (!set.captured.edge_sag.empty()) list_edges(set, distances, placement, particles, near);
  find_edge_points(set, placement, particles, near);
  if (!set.captured.face_sag.empty()) list_faces(set, faces, placement, particles, near);
}

}  // namespace gracilis
