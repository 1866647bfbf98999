#include <gracilis/geometry/section_frames.hpp>

#include <gracilis/geometry/rotations.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace gracilis {

Points subdivide_line(const Points& line, int scaling) {
  assert(line.cols() >= 2 && scaling >= 0 && scaling <= 16);
  const Eigen::Index parts = Eigen::Index(1) << scaling;
  Points result(3, (line.cols() - 1) * parts + 1);
  for (Eigen::Index i = 0; i < result.cols(); ++i) {
    const Eigen::Index before = i / parts;
    const Real share = static_cast<Real>(i % parts) / static_cast<Real>(parts);
    result.col(i) = share == 0 ? Vec3(line.col(before)) : (1 - share) * line.col(before) + share * line.col(before + 1);
  }
  return result;
}

Vec3 SectionFrames::ray(Eigen::Index k, Eigen::Index ray, Eigen::Index rays) const {
  const Real angle = 2 * pi * static_cast<Real>(ray) / static_cast<Real>(rays);
  const Vec3 first = first_rays.col(k), normal = normals.col(k);
  return std::cos(angle) * first + std::sin(angle) * normal.cross(first);
}

Eigen::Matrix3d SectionFrames::axes(Eigen::Index k) const {
  Eigen::Matrix3d axes;
  axes << first_rays.col(k), normals.col(k).cross(first_rays.col(k)), normals.col(k);
  return axes;
}

/// Unit, of section `k`.
static Vec3 plane_normal(const Points& line, Eigen::Index k, SectionPlanes planes) {
  const Eigen::Index before = std::max<Eigen::Index>(k - 1, 0), after = std::min(k + 1, line.cols() - 1);
  if (planes == SectionPlanes::fixed) return -Vec3::UnitY();
  const bool whole_part = planes == SectionPlanes::forward && after > k;
  const Vec3 normal = line.col(after) - line.col(whole_part ? k : before);
  // A line that turns back on itself has no difference there: the part before it stands in.
  return normal.norm() < 1e-9 ? (line.col(k) - line.col(before)).normalized() : normal.normalized();
}

SectionFrames section_frames(const Points& line, const Vec3& first, SectionPlanes planes) {
  const Eigen::Index n = line.cols();
  SectionFrames frames{Eigen::Matrix3Xd(3, n), Eigen::Matrix3Xd(3, n)};
  for (Eigen::Index k = 0; k < n; ++k) frames.normals.col(k) = plane_normal(line, k, planes);
  Vec3 ray = first;
  for (Eigen::Index k = 0; k < n; ++k) {
    const Vec3 normal = frames.normals.col(k);
    if (k > 0) ray = turn_from_to(frames.normals.col(k - 1), normal) * ray;
    ray -= ray.dot(normal) * normal;  // rounding, or the first ray as given
    if (ray.norm() < 1e-6) ray = normal.unitOrthogonal();
    frames.first_rays.col(k) = ray.normalized();
    ray = frames.first_rays.col(k);
  }
  return frames;
}

}  // namespace gracilis
