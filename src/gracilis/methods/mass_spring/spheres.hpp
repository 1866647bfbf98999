#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

#include <vector>

/// Spheres that stand for surfaces in collisions (Janák 2012, section 4.3).
namespace gracilis::mass_spring {

struct Spheres {
  Points centers = Points(3, 0);  ///< m
  std::vector<Real> radii;        ///< m

  Index count() const { return static_cast<Index>(radii.size()); }  ///< of spheres
};

/// A muscle's radii, per particle: the mean distance to the vertices (m) of which it is the nearest among the particles
/// `on_boundary`; 0 where it is that of none. Then shrunk until none intersect.
std::vector<Real> muscle_radii(const Points& particles, const std::vector<char>& on_boundary, const Points& vertices);

/// Shrinks spheres, the largest first, until no two intersect: of two that do the larger one gives way until they touch
/// or are as large as each other, then both. Radii of 0 stay.
void shrink_apart(const Points& centers, std::vector<Real>& radii);

/// A bone's spheres: vertices are taken in their order as roots, each with its `rings` (1 or 2) of vertices around it,
/// which are roots no more. The sphere's center lies as far below the root, against its normal, as the farthest of
/// these vertices is from it (for one ring: its longest edge), and its radius is √2 times that.
Spheres bone_spheres(const TriangleMesh& surface, int rings);

}  // namespace gracilis::mass_spring
