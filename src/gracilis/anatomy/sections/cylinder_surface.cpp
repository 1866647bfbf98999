#include <gracilis/anatomy/sections/cylinder_surface.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

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
