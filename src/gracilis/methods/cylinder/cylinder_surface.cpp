#include <gracilis/methods/cylinder/cylinder_surface.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

Vec3 SectionFrames::ray(Eigen::Index k, Eigen::Index ray, Eigen::Index rays) const {
  const Real angle = 2 * pi * static_cast<Real>(ray) / static_cast<Real>(rays);
  const Vec3 first = first_rays.col(k), normal = normals.col(k);
  return std::cos(angle) * first + std::sin(angle) * normal.cross(first);
}

SectionFrames section_frames(const Points& line, const Vec3& first) {
  const Eigen::Index n = line.cols();
  SectionFrames frames{Eigen::Matrix3Xd(3, n), Eigen::Matrix3Xd(3, n)};
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::Index before = std::max<Eigen::Index>(k - 1, 0), after = std::min(k + 1, n - 1);
    Vec3 normal = line.col(after) - line.col(before);
    // A line that turns back on itself has no difference there: the part before it stands in.
    if (normal.norm() < 1e-9) normal = line.col(k) - line.col(before);
    frames.normals.col(k) = normal.normalized();
  }
  Vec3 ray = first;
  for (Eigen::Index k = 0; k < n; ++k) {
    const Vec3 normal = frames.normals.col(k);
    if (k > 0) ray = Eigen::Quaterniond::FromTwoVectors(frames.normals.col(k - 1), normal) * ray;
    ray -= ray.dot(normal) * normal;  // rounding, or the first ray as given
    if (ray.norm() < 1e-6) ray = normal.unitOrthogonal();
    frames.first_rays.col(k) = ray.normalized();
    ray = frames.first_rays.col(k);
  }
  return frames;
}

Points section_vertices(const Points& line, const SectionFrames& frames, const Eigen::MatrixXd& radii) {
  const Eigen::Index rays = radii.rows(), sections = radii.cols();
  Points vertices(3, rays * sections + 2);
  for (Eigen::Index k = 0; k < sections; ++k)
    for (Eigen::Index i = 0; i < rays; ++i)
      vertices.col(k * rays + i) = line.col(k) + radii(i, k) * frames.ray(k, i, rays);
  vertices.col(rays * sections) = line.col(0);
  vertices.col(rays * sections + 1) = line.col(sections - 1);
  return vertices;
}

Eigen::Matrix3Xi section_faces(Index sections, Index rays) {
  Eigen::Matrix3Xi faces(3, 2 * rays * (sections - 1) + 2 * rays);
  Index face = 0;
  const Index first_center = rays * sections, last_center = first_center + 1;
  for (Index i = 0; i < rays; ++i) {
    const Index next = (i + 1) % rays;
    for (Index k = 0; k + 1 < sections; ++k) {
      const Index a = k * rays + i, b = k * rays + next, c = a + rays, d = b + rays;
      faces.col(face++) = Eigen::Vector3i(a, b, d);
      faces.col(face++) = Eigen::Vector3i(a, d, c);
    }
    const Index last = (sections - 1) * rays;
    faces.col(face++) = Eigen::Vector3i(first_center, next, i);
    faces.col(face++) = Eigen::Vector3i(last_center, last + i, last + next);
  }
  return faces;
}

}  // namespace gracilis
