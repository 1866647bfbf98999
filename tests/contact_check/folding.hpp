#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

#include <array>
#include <vector>

namespace gracilis::contact_check {

/// Two faces of a surface that share an edge and run along it in opposite directions.
struct Dihedral {
  Index start = 0, end = 0;   ///< the edge, as the left face runs along it
  Index left = 0, right = 0;  ///< the vertices opposite the edge
};

/// The dihedrals of a surface; edges with one face or more than two have none.
std::vector<Dihedral> dihedrals_of(const TriangleMesh& mesh);

/// The angle between the faces' normals, positive where the surface is convex (normals outward), in (-π, π]; NaN when
/// a face has no area.
Real dihedral_angle_of(const Dihedral& dihedral, const Points& points);

/// How far an angle turned, modulo a full turn: in [0, π]; NaN from NaN.
Real turned_by(Real angle, Real rest_angle);

/// The volume that a closed surface encloses, m³ (divergence theorem).
Real enclosed_volume(const Points& points, const Eigen::Matrix3Xi& faces);

}  // namespace gracilis::contact_check
