#include <gracilis/anatomy/sections/section_rings.hpp>

#include <Eigen/Geometry>

namespace gracilis {

Real triangle_area(const SectionRings& rings, Index section, Index ray) {
  const Vec3 center = rings.centers.col(section);
  const Vec3 a = rings.corner(section, ray) - center, b = rings.corner(section, (ray + 1) % rings.rays) - center;
  return a.cross(b).norm() / 2;
}

Real section_area(const SectionRings& rings, Index section) {
  Real area = 0;
  for (Index i = 0; i < rings.rays; ++i) area += triangle_area(rings, section, i);
  return area;
}

}  // namespace gracilis
