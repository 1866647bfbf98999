#pragma once

#include <gracilis/geometry/polylines.hpp>
#include <gracilis/methods/mass_spring/settings.hpp>
#include <gracilis/scene/scene.hpp>

#include <vector>

/// Points with a mass along the fibers of a muscle (Janák 2012, sections 4.2 and 4.4).
namespace gracilis::mass_spring {

/// A line's points at equal arc length, `count` of them (3 or more): the first where the line begins, the second after
/// the share `first_share` (0 to 1) of the sampling step SL = length / (count - 2), then one after every SL; the last
/// where the line ends, which as published it need not reach.
Points sampled_along(const Points& line, Index count, Real first_share);

/// The particles of all fibers, one line per fiber; the first step of each is random in [0, SL], by `seed`.
Polylines particles_along(const Polylines& fibers, Index per_fiber, int seed);

/// The bone nearest to a point.
struct NearestBone {
  Index body = -1;    ///< -1: the scene has no bone
  Real distance = 0;  ///< m, to its surface, from inside and outside alike
};
/// For each point in the capture pose (3 × n, m).
std::vector<NearestBone> nearest_bones(const Scene& scene, const Points& points);

/// Per particle: the body that it is fixed to, or -1.
std::vector<Index> fixed_bodies(const Muscle& muscle, const Points& particles, const std::vector<NearestBone>& bones,
                                FixedNear near, Real distance);

/// Per particle: whether its fiber is a boundary fiber, one with a particle that is the nearest one of some vertex of
/// the surface (3 × n, m).
std::vector<char> on_boundary_fibers(const Polylines& particles, const Points& vertices);

}  // namespace gracilis::mass_spring
