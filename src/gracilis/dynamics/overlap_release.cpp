#include <gracilis/dynamics/overlap_release.hpp>

#include <algorithm>
#include <limits>

namespace gracilis {

namespace {

/// The share of an overlap at rest that is given back in each step, and the least of it, m.
constexpr float given_back = 1.0f / 25, least_given_back = 0.00005f;

}  // namespace

float released(float before, float gap, bool overlapped_at_rest) {
  const float missing = gap - before;
  if (!(missing > 0)) return gap;
  const float step = overlapped_at_rest ? std::max(least_given_back, given_back * missing) : asked_at_once;
  return std::min(gap, before + step);
}

float OverlapRelease::most_gap(const PointTouch& touch, float gap) const {
  const bool overlapped = overlapped_at_rest(touch.particle);
  if (!overlapped && gap - touch.distance <= asked_at_once) return std::numeric_limits<float>::infinity();
  const Eigen::Vector3f p = probe.position(touch.particle) + shift;
  const NearestFace nearest = walk_to_nearest(p, surface, touch.face, target);
  return released(touch.side * point_gap(p, surface, nearest, target, normals).distance, gap, overlapped);
}

}  // namespace gracilis
