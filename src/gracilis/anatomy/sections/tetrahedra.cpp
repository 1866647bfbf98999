#include <gracilis/anatomy/sections/tetrahedra.hpp>

#include <gracilis/geometry/rotations.hpp>

#include <Eigen/Geometry>

#include <cassert>
#include <cmath>

namespace gracilis {

namespace {

/// Sections with those in between where compartments meet.
struct DividedSections {
  SectionRings rings;
  std::vector<Compartment> compartments;  ///< of what follows each section but the last
};

}  // namespace

static void append(SectionRings& rings, const Vec3& center, const Points& corners) {
  const Eigen::Index n = rings.centers.cols();
  rings.centers.conservativeResize(3, n + 1);
  rings.centers.col(n) = center;
  rings.corners.conservativeResize(3, (n + 1) * rings.rays);
  rings.corners.rightCols(rings.rays) = corners;
}

static DividedSections divided(const SectionRings& rings, const std::vector<Real>& places, Real origin_tendon,
                               Real tendon) {
  const Real borders[2] = {places.front() + origin_tendon, places.back() - tendon};
  DividedSections result;
  result.rings.rays = rings.rays;
  const auto corners = [&](Index k) -> Points { return rings.corners.middleCols(k * rings.rays, rings.rays); };
  const auto kind = [&](Real middle) {
    return middle > borders[0] && middle < borders[1] ? Compartment::muscle : Compartment::tendon;
  };
  append(result.rings, rings.centers.col(0), corners(0));
  for (Index k = 1; k < rings.sections(); ++k) {
    const Real from = places[static_cast<std::size_t>(k) - 1], to = places[static_cast<std::size_t>(k)];
    Real last = from;
    for (const Real border : borders) {
      const Real share = (border - from) / (to - from);
      if (!(share > 1e-6 && share < 1 - 1e-6) || border <= last) continue;
      result.compartments.push_back(kind((last + border) / 2));
      append(result.rings, (1 - share) * rings.centers.col(k - 1) + share * rings.centers.col(k),
             (1 - share) * corners(k - 1) + share * corners(k));
      last = border;
    }
    result.compartments.push_back(kind((last + to) / 2));
    append(result.rings, rings.centers.col(k), corners(k));
  }
  return result;
}

Tetrahedra tetrahedra_of(const SectionRings& rings, const std::vector<Real>& places, Real origin_tendon, Real tendon) {
  assert(static_cast<Index>(places.size()) == rings.sections() && rings.sections() >= 2);
  const DividedSections sections = divided(rings, places, origin_tendon, tendon);
  const Index rays = rings.rays, count = sections.rings.sections();
  Tetrahedra result;
  result.points.resize(3, count * (rays + 1));
  result.points << sections.rings.corners, sections.rings.centers;
  result.cells.resize(4, 3 * rays * (count - 1));
  Eigen::Index cell = 0;
  for (Index k = 0; k + 1 < count; ++k)
    for (Index i = 0; i < rays; ++i) {
      const Index a = k * rays + i, b = k * rays + (i + 1) % rays, c = a + rays, d = b + rays;
      const Index here = count * rays + k, next = here + 1;
      // All squares about the line are cut from this section's center on, and the outer ones as section_faces does.
      result.cells.col(cell++) << here, a, b, d;
      result.cells.col(cell++) << here, a, d, c;
      result.cells.col(cell++) << here, c, d, next;
      result.compartments.insert(result.compartments.end(), 3, sections.compartments[static_cast<std::size_t>(k)]);
    }
  return result;
}

Real cell_volume(const Tetrahedra& tetrahedra, Eigen::Index cell) {
  const auto corner = [&](int k) -> Vec3 { return tetrahedra.points.col(tetrahedra.cells(k, cell)); };
  const Vec3 origin = corner(0);
  return (corner(1) - origin).dot((corner(2) - origin).cross(corner(3) - origin)) / 6;
}

Real compartment_volume(const Tetrahedra& tetrahedra, Compartment compartment) {
  Real volume = 0;
  for (Eigen::Index cell = 0; cell < tetrahedra.cells.cols(); ++cell)
    if (tetrahedra.compartments[static_cast<std::size_t>(cell)] == compartment) volume += cell_volume(tetrahedra, cell);
  return volume;
}

SectionShape section_shape(const SectionRings& rings, Index section) {
  const auto corner = [&](Index i) -> Vec3 { return rings.corner(section, i % rings.rays); };
  const Vec3 center = rings.centers.col(section);
  SectionShape shape;
  Vec3 twice = Vec3::Zero();
  for (Index i = 0; i < rings.rays; ++i) {
    twice += (corner(i) - center).cross(corner(i + 1) - center);
    shape.perimeter += (corner(i + 1) - corner(i)).norm();
  }
  shape.area = twice.norm() / 2;
  shape.quotient = shape.perimeter > 0 ? 4 * pi * shape.area / (shape.perimeter * shape.perimeter) : 0;
  // Convex where it turns the same way at every corner (eq. 3.17); rounding does not count.
  shape.convex = true;
  for (Index i = 0; i < rings.rays; ++i) {
    const Vec3 turn = (corner(i + 1) - corner(i)).cross(corner(i + 2) - corner(i + 1));
    if (turn.dot(twice) < -1e-9 * twice.squaredNorm()) shape.convex = false;
  }
  return shape;
}

Real physiological_area(Real muscle_volume, Real pennation, Real optimal_fiber) {
  return muscle_volume * std::cos(pennation) / optimal_fiber;
}

SectionRings rings_of(const Points& vertices, Index rays, const Points& rest, const Points& rest_centers) {
  SectionRings rings{rays, rest_centers, vertices.leftCols(rays * rest_centers.cols())};
  for (Index k = 0; k < rings.sections(); ++k) {
    const Points before = rest.middleCols(k * rays, rays), now = rings.corners.middleCols(k * rays, rays);
    const Vec3 middle = before.rowwise().mean(), moved = now.rowwise().mean();
    const Points from = before.colwise() - middle, to = now.colwise() - moved;
    const Eigen::Matrix3d both = to * from.transpose();
    const Real size = from.squaredNorm() > 0 ? std::sqrt(to.squaredNorm() / from.squaredNorm()) : 1;
    rings.centers.col(k) = moved + size * (nearest_rotation(both) * (rest_centers.col(k) - middle));
  }
  return rings;
}

}  // namespace gracilis
