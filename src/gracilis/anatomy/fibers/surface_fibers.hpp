#pragma once

#include <gracilis/geometry/polylines.hpp>
#include <gracilis/scene/scene.hpp>

#include <vector>

namespace gracilis {

/// A piece of a surface fiber: an edge of the muscle's surface that may contract.
struct FiberSegment {
  Index a = 0, b = 0;    ///< vertices, a < b
  Real rest_length = 0;  ///< m
  Index fibers = 0;      ///< how many fibers run along it
};

/// Fibers on the surface, ready to become contraction constraints.
struct SurfaceFibers {
  std::vector<std::vector<Index>> paths;  ///< per fiber its vertices; neighbors share an edge
  std::vector<FiberSegment> segments;     ///< each edge once, ascending; those off the fiber direction left out
  Index rejected = 0;  ///< distinct edges of paths that lie more than `largest_segment_angle` off the fiber direction
  Real coverage = 0;   ///< share of the free surface's area whose vertices lie on a segment or next to one
};

/// Edges of a path farther off the fiber direction than this do not contract.
inline constexpr Real largest_segment_angle = radians(60);

/// Carries fibers onto the surface of their muscle. The fiber direction at an edge is the mean of the directions of the
/// four inner fiber pieces nearest to its middle. Without `reject` all edges of the paths are segments, as published.
/// Deterministic for any number of threads.
SurfaceFibers surface_fibers(const Muscle& muscle, const Polylines& fibers,
                             SurfacePaths paths = SurfacePaths::along_fibers, bool reject = true);

/// Fibers drawn by hand on the surface: their points' nearest vertices, joined by shortest ways; no edge is rejected.
SurfaceFibers surface_fibers_from_lines(const Muscle& muscle, const Polylines& lines);

/// The segments along which a muscle contracts by its settings unless all edges pull (`spread`): of lines drawn by hand
/// where there are any, or of its fibers in as many pieces as the settings say.
SurfaceFibers contracting_fibers(const Muscle& muscle);

/// The segments as lines of two points each.
Polylines segment_lines(const SurfaceFibers& fibers, const Points& vertices);

/// Which way fibers run at places (3 × k): the weighted mean direction of the fiber pieces nearest to each, unit; zero
/// where they cancel. Precondition: there is a fiber.
Points directions_of_fibers(const Polylines& fibers, const Points& places);

}  // namespace gracilis
