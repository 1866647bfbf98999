#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/polylines.hpp>
#include <gracilis/geometry/signed_distance.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <span>

namespace gracilis {

/// Moves the points of a line that lie outside of the surface, or less than `depth` (m) inside, to that depth below the
/// nearest point of the surface. Where the surface is too thin or too sharp for it, as deep as can be reached.
void move_inside(const TriangleMesh& surface, const SignedDistance& distance, Real depth, Points& line);

/// Smooths a line in `rounds` rounds, each of which moves every inner point half way to the middle of its neighbors and
/// then inside the surface again. The ends stay where they are. `limits`, where there are any, say per point how far it
/// moves from where it was at first: with the way d (m), d · limit d stays at most 1.
void smooth_inside(const TriangleMesh& surface, const SignedDistance& distance, Real depth, int rounds, Points& line,
                   std::span<const Eigen::Matrix3d> limits = {});

/// How far fibers keep from being inside.
struct Containment {
  Index points = 0;
  Index outside = 0;  ///< farther out than 1e-9 m
  Real farthest = 0;  ///< m
};
/// Of all points of the fibers (m) in the surface that `distance` is of.
Containment containment(const SignedDistance& distance, const Polylines& fibers);

}  // namespace gracilis
