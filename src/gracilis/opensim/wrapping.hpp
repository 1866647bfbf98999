#pragma once

#include <gracilis/opensim/model.hpp>

namespace gracilis::opensim {

/// How a line between two points meets a wrap object.
struct Wrap {
  enum class Kind {
    none,    ///< the line runs past it
    inside,  ///< one of the points lies in it
    held,    ///< the line misses it, but the path is held on one side
    needed   ///< the line cuts it
  };
  Kind kind = Kind::none;
  Vec3 first = Vec3::Zero(), last = Vec3::Zero();  ///< where the path touches and leaves, in the object's frame
  Real length = 0;                                 ///< m, between these on the surface
};

/// The shortest way from a to b (in the object's frame) around the object, on the side that it is held on. An obstacle
/// (Garner and Pandy 2000) is passed in its sense as long as less than half a turn touches it. Inside a torus' ring the
/// way is that around a cylinder along its tube where the line comes nearest to it, as OpenSim has it.
Wrap wrap_around(const WrapObject& object, const Vec3& a, const Vec3& b);

/// Around an ellipsoid: of the ways in planes through both points the shortest.
Wrap wrap_ellipsoid(const WrapObject& object, const Vec3& a, const Vec3& b);

}  // namespace gracilis::opensim
