#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

namespace gracilis {

/// A plane in which a surface is nearly its own mirror image.
struct SymmetryPlane {
  Vec3 point = Vec3::Zero();    ///< m
  Vec3 normal = Vec3::UnitZ();  ///< unit
  Real misfit = 0;              ///< m, root mean square distance of mirrored points from the surface
};

/// The plane of symmetry near one through the surface's middle with the normal `about` (unit): points and what is
/// nearest to their mirror images, in turns with the plane that mirrors the ones best onto the others, whose normal is
/// the least eigenvector of their covariance. Precondition: at least one face.
SymmetryPlane symmetry_plane(const TriangleMesh& mesh, const Vec3& about);

}  // namespace gracilis
