#include <gracilis/dynamics/contact/surface/overlap_release.hpp>

#include <algorithm>
#include <limits>

namespace gracilis {

float released(float before, float gap, float speed) { return std::min(gap, before + speed); }

float OverlapRelease::most_gap(const VertexFaceCandidate& candidate, float gap) const {
  const bool overlapped = overlaps_at_rest(overlaps, candidate.particle);
  if (!overlapped && gap - candidate.distance <= asked_at_once) return std::numeric_limits<float>::infinity();
  const Eigen::Vector3f p = probe.position(candidate.particle) + shift;
  const NearestFace nearest = exit.walk(candidate.particle, p, candidate.face, target);
  return released(candidate.side * point_gap(p, exit.surface, nearest, target, normals).distance, gap,
                  overlapped ? speed : asked_at_once);
}

}  // namespace gracilis
