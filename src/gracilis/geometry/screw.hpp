#pragma once

#include <gracilis/core/types.hpp>

namespace gracilis {

/// A rigid motion as a turn about an axis and a slide along it (Chasles).
struct Screw {
  Vec3 axis = Vec3::UnitX();
  Real angle = 0;  ///< rad
  Real slide = 0;  ///< m
};

/// Of a motion that turns by next to nothing only the slide is told, as if it were along the axis.
Screw screw_of(const RigidTransform& motion);

/// The share t of a rigid motion, along its screw: the same motion whatever frame it is written in, and about a hinge
/// for what turns about a hinge. Precondition: it turns by less than half a turn.
RigidTransform share_of_screw(const RigidTransform& motion, Real t);

}  // namespace gracilis
