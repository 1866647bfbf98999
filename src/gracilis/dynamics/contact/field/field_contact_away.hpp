#pragma once

#include <gracilis/dynamics/contact/field/near_field.hpp>
#include <gracilis/dynamics/particles.hpp>

#include <Eigen/Geometry>

namespace gracilis {

/// How a whole surface moved against an obstacle since it was last seen, at most.
struct SurfaceMotion {
  float farthest = 0;       ///< m, that a particle went in the particles' frame
  Eigen::AlignedBox3f box;  ///< of where they are
};

/// From one place of the particles to the next; infinite where their numbers differ.
SurfaceMotion surface_motion(const Particles& from, const Particles& to);

/// How far the obstacle's frame carried anything in the box against the particles' frame, m.
float carried(const FieldPlacement& from, const FieldPlacement& to, const Eigen::AlignedBox3f& box);

/// Takes from what the surface was away what it may have used up; most surfaces are far away from most obstacles, and
/// need not be looked at particle by particle until that is spent.
float away_after(const SurfaceMotion& motion, const FieldPlacement& placement, const Away& away);

/// What is known about how far the surface is away, right after all its particles have been seen.
Away seen_away(const FieldContactSet& set, const FieldPlacement& placement, const NearField& near);

}  // namespace gracilis
