#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

#include <string>
#include <vector>

namespace gracilis {

/// A repaired surface and what was done to it.
struct RepairedMesh {
  TriangleMesh mesh;
  std::vector<std::string>
      repairs;  ///< one clause each, such as "dropped 3 unreferenced vertices, first 17"; empty: untouched
};

/// Repairs what has one obvious repair and changes nothing else; a sound surface comes back bit for bit the same, in
/// the same order:
/// - vertices at the same place become one, where that closes open edges or removes faces without area and does no harm
///   elsewhere (surfaces may touch themselves on purpose);
/// - faces that name a vertex twice are dropped; where a face is a line, its longest edge is flipped;
/// - components with less than `crumb_share` of the area are dropped (0: none);
/// - vertices in no face are dropped;
/// - faces are turned so that neighbors agree and each piece of a closed surface faces outwards (positive volume); what
///   lies within another piece turns with it.
/// Indices must be in range and coordinates finite.
RepairedMesh repair_mesh(const TriangleMesh& mesh, Real crumb_share = 0);

}  // namespace gracilis
