#pragma once

#include <gracilis/geometry/wrapping.hpp>

#include <functional>
#include <vector>

namespace gracilis {

/// A point that a path runs through now.
struct PathStop {
  Index body = 0;
  Vec3 place = Vec3::Zero();  ///< in the world
  int given = -1;             ///< index among the path's own points; -1: where it meets or leaves a wrap surface
  int wrap = -1;              ///< index among its wraps; two neighbors of the same one have an arc between them
  Wrap around;                ///< on the second of the two, in the surface's frame
};

/// A surface that a path may run around, between these of its own points.
struct PlacedWrap {
  WrapSurface surface;
  RigidTransform frame = RigidTransform::Identity();  ///< in the world
  Index body = 0;
  int first_point = 0, last_point = 0;  ///< counted from 0, those that are not there now as well
  WrapSurface::Plane plane = WrapSurface::Plane::hybrid;
};

Real length_of(const std::vector<PathStop>& points);  ///< m, with the ways around wraps

/// How a path is found: around one surface from a to b, in the surface's frame, and what is its length, by which the
/// rounds end.
struct PathSolver {
  std::function<Wrap(const PlacedWrap& wrap, const Vec3& a, const Vec3& b)> wrap = [](const PlacedWrap& placed,
                                                                                      const Vec3& a, const Vec3& b) {
    return wrap_around(placed.surface, a, b, placed.plane);
  };
  std::function<Real(const std::vector<PathStop>& points)> length = length_of;
};

/// Takes a path that runs straight through its own points around the surfaces. These are tried in order, up to eight
/// times where there are several, as OpenSim does; each takes the first part that cuts it, or the one that it lengthens
/// least. `points` are those that are there now.
void solve_path(const std::vector<PlacedWrap>& wraps, std::vector<PathStop>& points, const PathSolver& solver = {});

/// The path as points on a line, those on surfaces at most `largest_turn` (rad) apart; neighbors less than 1e-9 m apart
/// become one. `bodies` of the points, where asked for.
Points line_through(const std::vector<PathStop>& points, const std::vector<PlacedWrap>& wraps, Real largest_turn,
                    std::vector<Index>* bodies = nullptr);

}  // namespace gracilis
