#include <gracilis/methods/cylinder/section_collision.hpp>

#include <gracilis/anatomy/sections/cylinder_surface.hpp>
#include <gracilis/geometry/measures.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

/// What lies on the way from a corner to its center of the way to the other corner; 0 where the angle is not acute.
static Real depth_at(const Vec3& corner, const Vec3& center, const Vec3& other) {
  const Real radius = (center - corner).norm();
  return radius > 0 ? std::max(0.0, (other - corner).dot(center - corner) / radius) : 0;
}

Real transversal_depth(const SectionRings& moved, const SectionCorner& corner, const SectionRings& other,
                       const SectionCorner& other_corner) {
  const Vec3 x = moved.corner(corner.section, corner.ray), y = other.corner(other_corner.section, other_corner.ray);
  return depth_at(x, moved.centers.col(corner.section), y) + depth_at(y, other.centers.col(other_corner.section), x);
}

static bool cuts_triangle(const Vec3& from, const Vec3& to, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 along = to - from, ab = b - a, ac = c - a, across = along.cross(ac);
  const Real determinant = ab.dot(across);
  if (std::abs(determinant) < 1e-300) return false;
  const Vec3 off = from - a, other = off.cross(ab);
  const Real u = off.dot(across) / determinant, v = along.dot(other) / determinant, t = ac.dot(other) / determinant;
  return u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < 1;
}

Obstacle obstacle_of(const SectionRings& rings) {
  Points vertices(3, rings.corners.cols() + 2);
  vertices << rings.corners, rings.centers.col(0), rings.centers.rightCols(1);
  const Eigen::Matrix3Xi faces = section_faces(rings.sections(), rings.rays);
  const Eigen::AlignedBox3d whole = bounding_box(vertices);
  return [vertices, faces, whole](const Vec3& a, const Vec3& b) {
    const Eigen::AlignedBox3d box(a.cwiseMin(b), a.cwiseMax(b));
    if (!whole.intersects(box)) return false;
    for (Eigen::Index f = 0; f < faces.cols(); ++f) {
      const Vec3 p = vertices.col(faces(0, f)), q = vertices.col(faces(1, f)), r = vertices.col(faces(2, f));
      const Eigen::AlignedBox3d own(p.cwiseMin(q).cwiseMin(r), p.cwiseMax(q).cwiseMax(r));
      if (own.intersects(box) && cuts_triangle(a, b, p, q, r)) return true;
    }
    return false;
  };
}

static void shift(SectionRings& rings, Index section, const Vec3& by) {
  rings.centers.col(section) += by;
  rings.corners.middleCols(section * rings.rays, rings.rays).colwise() += by;
}

bool yield_to_transversal(SectionRings& rings, const SectionCorner& corner, Real depth) {
  const Vec3 way = rings.centers.col(corner.section) - rings.corner(corner.section, corner.ray);
  const Real radius = way.norm();
  if (depth <= radius || radius == 0) return false;
  shift(rings, corner.section, (depth - radius) / radius * way);
  return true;
}

YieldingSection::YieldingSection(const SectionRings& rings, Index section)
    : area(section_area(rings, section)), radii(rings.rays), fixed(static_cast<std::size_t>(rings.rays), false) {
  for (Index i = 0; i < rings.rays; ++i) radii[i] = (rings.corner(section, i) - rings.centers.col(section)).norm();
}

bool yield_to_obstacle(SectionRings& rings, Index section, const Obstacle& cuts, YieldingSection& state) {
  const Index rays = rings.rays, neighbor = section + 1 < rings.sections() ? section + 1 : section - 1;
  std::vector<bool> shrinks(static_cast<std::size_t>(rays), false), pushes = shrinks;
  bool any = false;
  for (Index i = 0; i < rays; ++i) {
    const Index next = (i + 1) % rays;
    if (cuts(rings.corner(section, i), rings.corner(section, next))) {
      shrinks[static_cast<std::size_t>(i)] = shrinks[static_cast<std::size_t>(next)] = true;
      any = true;
    }
    if (cuts(rings.corner(section, i), rings.corner(neighbor, next))) pushes[static_cast<std::size_t>(i)] = any = true;
  }
  if (!any) return false;
  const Vec3 center = rings.centers.col(section);
  Vec3 push = Vec3::Zero();
  int pushing = 0;
  for (Index i = 0; i < rays; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const Vec3 radius = rings.corner(section, i) - center;
    const bool spent = radius.norm() < 0.05 * state.radii[i];
    if (shrinks[at]) {
      state.fixed[at] = true;
      if (!spent) rings.corner(section, i) = center + 0.9 * radius;
    }
    if ((shrinks[at] && spent) || pushes[at]) {
      push += 0.1 * (rings.corner(section, (i + rays / 2) % rays) - center);
      ++pushing;
    }
  }
  if (pushing > 0) {
    shift(rings, section, push / pushing);
    state.pushed += push / pushing;
  }
  return true;
}

void take_back(SectionRings& rings, Index section, YieldingSection& state) {
  shift(rings, section, -state.pushed);
  state.pushed.setZero();
}

void inflate(SectionRings& rings, Index section, Real area, const std::vector<bool>& fixed) {
  // With s the scale of the free radii the area is held + s mixed + s² free.
  Real held = 0, mixed = 0, free = 0;
  for (Index i = 0; i < rings.rays; ++i) {
    const bool a = fixed[static_cast<std::size_t>(i)], b = fixed[static_cast<std::size_t>((i + 1) % rings.rays)];
    (a && b ? held : a || b ? mixed : free) += triangle_area(rings, section, i);
  }
  if (!(mixed + free > 0)) return;
  const Real missing = area - held;
  Real scale =
      free > 0 ? (-mixed + std::sqrt(std::max(0.0, mixed * mixed + 4 * free * missing))) / (2 * free) : missing / mixed;
  scale = std::clamp(scale, 1.0, 3.0);
  const Vec3 center = rings.centers.col(section);
  for (Index i = 0; i < rings.rays; ++i)
    if (!fixed[static_cast<std::size_t>(i)])
      rings.corner(section, i) = center + scale * (rings.corner(section, i) - center);
}

}  // namespace gracilis
