#pragma once

#include <gracilis/anatomy/resolution/divided_muscle.hpp>
#include <gracilis/geometry/nearest_triangle.hpp>

#include <span>
#include <vector>

namespace gracilis {

/// A muscle's surface as the reader of a scene has it: with its needles divided, if it is made of them.
struct SurfaceAsRead {
  /// Divides the needles of a surface as it is in its file (m).
  explicit SurfaceAsRead(const TriangleMesh& of_file);

  /// Where these vertices of the file are (ascending), and those that came between two of them: a cloud that names
  /// them all, whether the scene divides needles or not.
  Points places(std::vector<Index> vertices) const;

  /// m, at most `most`: a distance within which such places are near to no other vertex. Fine surfaces have vertices
  /// closer to each other than any fixed distance.
  Real reach_of(const Points& places, Real most) const;

  TriangleMesh mesh;
  VerticesBetween added;
};

/// m, in steps of 0.1 mm: the least distance, not below `least`, within which each point has one of the surfaces.
Real distance_to_all(const Points& points, std::span<const NearestTriangle* const> surfaces, Real least);

}  // namespace gracilis
