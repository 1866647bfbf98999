#pragma once

#include <gracilis/geometry/signed_distance.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/methods/tissue/lattice.hpp>

#include <array>
#include <vector>

namespace gracilis::tissue {

/// What is seen of a muscle keeps so far from bones (m), or as far as in the capture pose where that is less: smooth
/// fields round sharp edges of bones off by some hundredths of a millimetre.
inline constexpr Real seen_clearance = 1e-4;
/// Splines of fields are off by less than this, m.
inline constexpr Real field_error = 1e-3;

/// A place on a flat triangle, by its corners' shares.
struct FacePlace {
  std::array<Index, 3> corners{0, 0, 0};  ///< vertices of the surface
  Vec3 shares = Vec3::Zero();
};

/// A triangle that is larger than half a cell and has a free corner.
struct LargeFace {
  Index face = -1;
  Index free_corner = -1;                  ///< a vertex
  Index places_begin = 0, places_end = 0;  ///< of `LargeFaces::places`
  Index kept_begin = 0, kept_end = 0;      ///< of `LargeFaces::kept`
};

/// A place on a large triangle and the tissue that lies there at rest.
struct LargeFacePlace {
  Vec3 shares = Vec3::Zero();
  EmbeddedPoint at;
  Real share = 0;  ///< of the triangle, in a mean over it
};

/// The triangles of a surface that are larger than half a cell.
struct LargeFaces {
  std::vector<LargeFace> faces;
  std::vector<LargeFacePlace> places;    ///< of the faces, one after the other
  std::vector<FacePlace> kept;           ///< on them and their edges: what is kept out of bones
  std::vector<std::vector<Real>> least;  ///< m, per bone and kept place: distance from it, see `seen_clearance`
};

/// `is_free`: per vertex. `least` is left empty.
LargeFaces find_large_faces(const TriangleMesh& surface, const std::vector<char>& is_free, const Lattice& lattice);

}  // namespace gracilis::tissue
