#include <gracilis/anatomy/fibers/fiber_knots.hpp>

#include <gracilis/anatomy/fibers/fiber_template.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/polylines.hpp>
#include <gracilis/geometry/principal_axes.hpp>

#include <algorithm>

namespace gracilis {

static Eigen::Matrix3d inverse_extents_of(const SectionMap& section) {
  constexpr Index probes = 32;
  constexpr Real least_variance = 1e-12;  // m²
  Points crossing(3, probes);
  Index probe = 0;
  for (const Eigen::Vector2d& start : spread_over_square(probes))
    crossing.col(probe++) = section.at(start.x(), start.y());
  const PrincipalAxes spread = spread_of(crossing);
  Eigen::Matrix3d found = Eigen::Matrix3d::Zero();
  for (const Index axis : {1, 2}) {  // the least is along the fibers, where sections are not flat
    const Vec3 across = spread.directions.col(axis);
    // Points that fill a section evenly lie up to √3 times their standard deviation from its middle.
    found += across * across.transpose() / std::max(3 * spread.values[axis] / probes, least_variance);
  }
  return found;
}

std::vector<Eigen::Matrix3d> inverse_extents(const std::vector<SectionMap>& sections) {
  const std::size_t count = sections.size();
  std::vector<Eigen::Matrix3d> found(count + 2, Eigen::Matrix3d::Zero());
  parallel_for_each(count, [&](std::size_t k) { found[k + 1] = inverse_extents_of(sections[k]); });
  if (count > 0) found.front() = found[1], found.back() = found[count];
  return found;
}

FiberKnots without_turning_back(const FiberKnots& all) {
  const Points& line = all.line;
  std::vector<Index> kept;
  for (Index k = 0; k < line.cols(); ++k) {
    const auto turns_back = [&] {
      const Vec3 here = line.col(kept.back()), before = line.col(kept[kept.size() - 2]);
      return (line.col(k) - here).dot(here - before) < 0;
    };
    while (kept.size() > 1 && turns_back()) kept.pop_back();
    kept.push_back(k);
  }
  FiberKnots found{line(Eigen::all, kept), {}};
  for (const Index k : kept) found.extents.push_back(all.extents[static_cast<std::size_t>(k)]);
  return found;
}

std::vector<Eigen::Matrix3d> smoothing_limits(const FiberKnots& knots, Real reach, Index count) {
  constexpr Real least_reach = 1e-6;  // so that nothing is divided by zero
  reach = std::max(reach, least_reach);
  const std::vector<Real> passed = distances_along(knots.line);
  std::vector<Eigen::Matrix3d> limits;
  std::size_t k = 1;
  for (Index i = 0; i < count; ++i) {
    const Real at = passed.back() * static_cast<Real>(i) / static_cast<Real>(count - 1);
    while (k + 1 < passed.size() && passed[k] < at) ++k;
    const Real way = passed[k] - passed[k - 1], share = way > 0 ? std::min((at - passed[k - 1]) / way, 1.0) : 0;
    limits.push_back(((1 - share) * knots.extents[k - 1] + share * knots.extents[k]) / (reach * reach));
  }
  return limits;
}

}  // namespace gracilis
