#include <gracilis/anatomy/fibers/nearest_fiber.hpp>

namespace gracilis {

NearestFiber::NearestFiber(const Polylines& fibers) {
  std::vector<Vec3> middles;
  for (Index line = 0; line < fibers.count(); ++line)
    for (Index p = fibers.begin(line); p + 1 < fibers.end(line); ++p) {
      const Vec3 along = fibers.points.col(p + 1) - fibers.points.col(p);
      if (!(along.norm() > 0)) continue;
      middles.emplace_back((fibers.points.col(p + 1) + fibers.points.col(p)) / 2);
      directions_.push_back(along.normalized());
    }
  if (middles.empty()) return;
  Points points(3, static_cast<Index>(middles.size()));
  for (std::size_t i = 0; i < middles.size(); ++i) points.col(static_cast<Index>(i)) = middles[i];
  nearest_.emplace(points);
}

Vec3 NearestFiber::direction(const Vec3& p) const {
  return nearest_ ? directions_[static_cast<std::size_t>(nearest_->nearest(p))] : Vec3(Vec3::Zero());
}

}  // namespace gracilis
