#include <gracilis/dynamics/contact/surface/overlap_release.hpp>

#include <algorithm>
#include <limits>

namespace gracilis {

float released(float before, float gap, float speed) { return std::min(gap, before + speed); }

float OverlapRelease::most_gap(const PointTouch& touch, float gap) const {
  const bool overlapped = overlapped_at_rest(touch.particle);
  if (!overlapped && gap - touch.distance <= asked_at_once) return std::numeric_limits<float>::infinity();
  const Eigen::Vector3f p = probe.position(touch.particle) + shift;
  const NearestFace nearest = walk_to_nearest(p, surface, touch.face, target);
  return released(touch.side * point_gap(p, surface, nearest, target, normals).distance, gap,
                  overlapped ? speed : asked_at_once);
}

}  // namespace gracilis
