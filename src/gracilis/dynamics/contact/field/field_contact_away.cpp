#include <gracilis/dynamics/contact/field/field_contact_away.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gracilis {

SurfaceMotion surface_motion(const Particles& from, const Particles& to) {
  SurfaceMotion motion;
  const bool is_known = from.count() == to.count();
  motion.farthest = is_known ? largest_motion(from, to) : std::numeric_limits<float>::infinity();
  for (Index p = 0; p < to.count(); ++p) motion.box.extend(Eigen::Vector3f(to.position(p)));
  return motion;
}

float carried(const FieldPlacement& from, const FieldPlacement& to, const Eigen::AlignedBox3f& box) {
  // The difference of two placements is linear, so it is largest in a corner.
  float farthest = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3f x = box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(corner));
    farthest = std::max(farthest, (to.to_obstacle(x) - from.to_obstacle(x)).norm());
  }
  return farthest;
}

float away_after(const SurfaceMotion& motion, const FieldPlacement& placement, const Away& away) {
  return away.distance - steepest * (motion.farthest + carried(away.placement, placement, motion.box));
}

Away seen_away(const FieldContactSet& set, const FieldPlacement& placement, const NearField& near) {
  Away away{std::numeric_limits<float>::infinity(), 0, placement};
  for (std::size_t p = 0; p < near.last.size(); ++p) {
    away.distance = std::min(away.distance, near.clearance[p] + near.gap[p]);
    away.largest_gap = std::max({away.largest_gap, set.captured.particle[p], set.released.particle[p]});
  }
  away.distance -= static_cast<float>(set.field.field->cell_size.maxCoeff());
  return away;
}

}  // namespace gracilis
