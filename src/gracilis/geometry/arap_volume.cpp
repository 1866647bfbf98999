#include <gracilis/geometry/arap_volume.hpp>

#include <gracilis/geometry/measures.hpp>

#include <cmath>

namespace gracilis::arap {

namespace {

/// Share of the target within which a volume is right, and how often the multiplier is improved.
constexpr Real accuracy = 1e-6;
constexpr int newton_steps = 6;

/// The gradient of the volume by every vertex, m²: a third of the area vectors around it.
Points volume_gradient(const Points& points, const Eigen::Matrix3Xi& faces) {
  Points gradient = Points::Zero(3, points.cols());
  for (Index f = 0; f < static_cast<Index>(faces.cols()); ++f) {
    const Vec3 share = area_vector(points, faces.col(f)) / 6;
    for (int k = 0; k < 3; ++k) gradient.col(faces(k, f)) += share;
  }
  return gradient;
}

}  // namespace

void restore_volume_by_multiplier(const Surface& surface, const Eigen::Matrix3Xi& faces, const std::vector<char>& held,
                                  Real target, Points& points) {
  if (std::abs(enclosed_volume(points, faces) - target) <= accuracy * target) return;
  Points forces = volume_gradient(points, faces);
  for (std::size_t v = 0; v < held.size(); ++v)
    if (held[v]) forces.col(static_cast<Index>(v)).setZero();
  const Points way = surface.response(forces);
  Real multiplier = 0;
  for (int i = 0; i < newton_steps; ++i) {
    const Points now = points + multiplier * way;
    const Real off = enclosed_volume(now, faces) - target;
    if (std::abs(off) <= accuracy * target) break;
    const Real slope = volume_gradient(now, faces).cwiseProduct(way).sum();
    if (!(slope > 0)) break;
    multiplier -= off / slope;
  }
  points += multiplier * way;
}

void restore_volume_by_scaling(const Eigen::Matrix3Xi& faces, const std::vector<char>& held, Real target,
                               Points& points) {
  const Real now = enclosed_volume(points, faces);
  if (!(now > 0)) return;
  const Real factor = std::cbrt(target / now);
  const Vec3 center = points.rowwise().mean();
  for (std::size_t v = 0; v < held.size(); ++v)
    if (const auto at = static_cast<Index>(v); !held[v])
      points.col(at) = center + factor * (Vec3(points.col(at)) - center);
}

}  // namespace gracilis::arap
