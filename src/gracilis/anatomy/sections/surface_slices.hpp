#pragma once

#include <gracilis/anatomy/sections/tetrahedra.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <vector>

namespace gracilis {

/// What a plane across a surface cuts out of it (Laclé 2014, section 3.5.2).
struct SurfaceSlice {
  Real place = 0;            ///< m, along the surface's longest axis from its beginning
  int outlines = 0;          ///< curves that the plane cuts; 0: none
  SectionShape shape;        ///< of the one with the largest area
  Eigen::Matrix2Xd outline;  ///< m, that one, counterclockwise about its centroid; the first point is not repeated
};

/// `count` slices at equal distances, at 1 / (count + 1) ... of the surface's extent along its longest axis (of the
/// covariance of its area). Precondition: a closed surface, count > 0.
std::vector<SurfaceSlice> surface_slices(const TriangleMesh& surface, int count);

}  // namespace gracilis
