#include <gracilis/opensim/import/neighbor_clearance.hpp>

#include <algorithm>
#include <limits>
#include <utility>

namespace gracilis::opensim {

static constexpr Real half_gap = 0.00025;  // m
static constexpr int steps = 16;           // along a ray, and halvings of the step in which it leaves its own room

/// How far a point is from a muscle's line, in radii there.
static Real radii_from(const RoundMuscle& muscle, const Vec3& p) {
  Real least = std::numeric_limits<Real>::infinity();
  for (Eigen::Index k = 0; k + 1 < muscle.centers.cols(); ++k) {
    const Vec3 a = muscle.centers.col(k), along = muscle.centers.col(k + 1) - a;
    const Real length2 = along.squaredNorm(),
               share = length2 > 0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0;
    const Real radius = muscle.radii[k] + share * (muscle.radii[k + 1] - muscle.radii[k]);
    least = std::min(least, (p - a - share * along).norm() / radius);
  }
  return least;
}

/// Whether any of the muscle may be nearer, in radii, to a point within `length` of the center.
static bool reaches(const RoundMuscle& muscle, const Vec3& center, Real length) {
  const Vec3 low = muscle.centers.rowwise().minCoeff(), high = muscle.centers.rowwise().maxCoeff();
  return (low - center).cwiseMax(center - high).cwiseMax(0.0).norm() < 3 * (muscle.radii.maxCoeff() + length);
}

RoomBeside room_beside(std::vector<RoundMuscle> muscles) {
  return [muscles = std::move(muscles)](const Vec3& center, const Vec3& ray, Real radius, Real length) {
    std::vector<const RoundMuscle*> near;
    for (const RoundMuscle& muscle : muscles)
      if (reaches(muscle, center, length)) near.push_back(&muscle);
    const auto is_own = [&](Real way) {
      const Vec3 p = center + (way + half_gap) * ray;
      return std::all_of(near.begin(), near.end(),
                         [&](const RoundMuscle* muscle) { return radii_from(*muscle, p) * radius > way + half_gap; });
    };
    Real own = 0, step = length / steps;
    while (own < length && is_own(std::min(own + step, length))) own = std::min(own + step, length);
    for (int i = 0; i < steps && own < length; ++i) {
      step /= 2;
      if (is_own(own + step)) own += step;
    }
    return own;
  };
}

}  // namespace gracilis::opensim
