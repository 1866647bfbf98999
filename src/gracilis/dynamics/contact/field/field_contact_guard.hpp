#pragma once

#include <gracilis/dynamics/contact/field/near_field.hpp>
#include <gracilis/dynamics/particles.hpp>

namespace gracilis {

/// Where a particle may be that wants to be at `q` (obstacle's frame) and was at `last`, by the set's guard; `gap` is
/// its gap now.
Eigen::Vector3f guarded(const FieldContactSet& set, const CachedQuery& last, const Eigen::Vector3f& q, float gap);

/// What is known to be farther away than this need not be seen before every step, m.
inline constexpr float far_away = 0.02f;

/// Where the particles are before obstacles and particles move: that side of the surface is theirs.
void remember_sides(const FieldContactSet& set, const FieldPlacement& placement, const Particles& particles,
                    NearField& near);

}  // namespace gracilis
