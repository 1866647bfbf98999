#include <gracilis/anatomy/fibers/fiber_seams.hpp>

#include <gracilis/geometry/angle_between.hpp>
#include <gracilis/geometry/principal_axes.hpp>

namespace gracilis {

/// The direction across which the field draws together most.
static Vec3 drawing_together(const FiberField& field, const Vec3& place, Real sign, Real reach) {
  Eigen::Matrix3d change;
  for (Index k = 0; k < 3; ++k)
    change.col(k) =
        sign * (field.direction(place + reach * Vec3::Unit(k)) - field.direction(place - reach * Vec3::Unit(k)));
  return principal_axes(change + change.transpose()).least();
}

std::optional<FiberSeam> seam_at(const FiberField& field, const Vec3& place, Real sign, Real reach) {
  constexpr Real least_turn = radians(15);
  const Vec3 here = sign * field.direction(place);
  Vec3 across = drawing_together(field, place, sign, reach);
  if (across.dot(here) < 0) across = -across;
  const Vec3 before = sign * field.direction(place - reach * across),
             after = sign * field.direction(place + reach * across);
  if (before.isZero() || after.isZero() || here.isZero()) return std::nullopt;
  const Real turn = angle_between(before, after);
  if (turn < least_turn || !(before.dot(across) > 0 && after.dot(across) < 0)) return std::nullopt;
  if (here.dot(across) > before.dot(across) / 2) return std::nullopt;
  const Vec3 along = (before + after).normalized();
  const Vec3 ahead = sign * field.direction(place + reach * along),
             behind = sign * field.direction(place - reach * along);
  if (!ahead.isZero() && !behind.isZero() && angle_between(ahead, behind) > turn / 2) return std::nullopt;
  // Where nothing leads across any more, found by halving.
  Real near = 0, far = reach;
  for (int i = 0; i < 20; ++i) {
    const Real middle = (near + far) / 2;
    (sign * field.direction(place + middle * across).dot(across) > 0 ? near : far) = middle;
  }
  return FiberSeam{place + near * across, across, before};
}

void end_at_seam(const FiberSeam& seam, Real reach, std::vector<Vec3>& way) {
  const auto distance = [&](const Vec3& p) { return seam.across.dot(seam.place - p); };
  while (way.size() > 1 && distance(way.back()) < reach) way.pop_back();
  if (way.empty()) return;
  const Vec3 from = way.back();
  way.push_back(from + std::max(0.0, distance(from)) / seam.before.dot(seam.across) * seam.before);
}

}  // namespace gracilis
