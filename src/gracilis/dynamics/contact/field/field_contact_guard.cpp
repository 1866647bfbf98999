#include <gracilis/dynamics/contact/field/field_contact_guard.hpp>

#include <gracilis/core/parallel.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

namespace {

/// Cosine of the turn by which the published test knows a vertex that passed through a bone.
const float turned_cosine = static_cast<float>(std::cos(radians(135)));

bool passed(const FieldContactSet& set, const Eigen::Vector3f& before, const Eigen::Vector3f& gradient_now) {
  const Eigen::Vector3f gradient = sample(set.field.grid, before).gradient;
  return gradient.dot(gradient_now) < turned_cosine * gradient.norm() * gradient_now.norm();
}

/// Whether the way from where it last was is so long that its end alone does not tell the side.
bool is_fast(const FieldContactSet& set, const CachedQuery& last, const Eigen::Vector3f& q, float gap) {
  const float moved = (q - last.place).norm(), safe = safe_step(*set.field.field);
  return moved > safe && moved > 0.9f * (last.distance - gap) - 2 * safe;
}

}  // namespace

Eigen::Vector3f guarded(const FieldContactSet& set, const CachedQuery& last, const Eigen::Vector3f& q, float gap) {
  if (set.guard == MotionGuard::kept_path && is_fast(set, last, q, gap))
    return kept_path(set.field, last.place, q, std::min(gap, last.distance));
  if (set.guard == MotionGuard::turned_direction && passed(set, last.place, sample(set.field.grid, q).gradient))
    return last.place;
  return q;
}

void remember_sides(const FieldContactSet& set, const FieldPlacement& placement, const Particles& particles,
                    NearField& near) {
  const auto count = static_cast<std::size_t>(particles.count());
  const bool known = near.last.size() == count;
  near.last.resize(count);
  const auto cell = static_cast<float>(set.field.field->cell_size.maxCoeff());
  parallel_for(particles.count(), contacts_per_task, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      CachedQuery& last = near.last[static_cast<std::size_t>(i)];
      const Eigen::Vector3f q = placement.to_obstacle(particles.position(i));
      if (!known || may_reach(last, q, far_away + cell)) last = {q, sample_bounded(set.field, q).distance};
    }
  });
}

}  // namespace gracilis
