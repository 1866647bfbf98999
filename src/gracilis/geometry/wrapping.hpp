#pragma once

#include <gracilis/core/types.hpp>

#include <array>

namespace gracilis {

/// A surface that lines run around (OpenSim's wrap objects), in a frame of its own.
struct WrapSurface {
  enum class Kind { cylinder, sphere, ellipsoid, torus };
  /// How OpenSim chooses the plane of the way around an ellipsoid (`<method>` of a path's wrap).
  enum class Plane { hybrid, midpoint, axial };
  Kind kind = Kind::cylinder;
  Real radius = 0, length = 0;  ///< m; the axis of a cylinder or torus is z; a torus' radius is that of its tube
  Vec3 radii = Vec3::Zero();    ///< m, of an ellipsoid
  Real ring_radius = 0;         ///< m, of the circle that a torus' tube lies about
  int hand = 0;                 ///< an obstacle is passed in this sense only: +1 counterclockwise about z, -1 clockwise
  int side_axis = -1;           ///< 0, 1, 2: lines pass on one side only, along this axis (OpenSim's quadrant)
  int side_sign = 0;            ///< +1 or -1
};

/// As scene files have them, in the order of the enumerators.
inline constexpr std::array<const char*, 4> wrap_kind_names = {"cylinder", "sphere", "ellipsoid", "torus"};
inline constexpr std::array<const char*, 3> wrap_plane_names = {"hybrid", "midpoint", "axial"};

/// A turn of an ellipse, climbing evenly: circles, ellipses and helices.
struct Arc {
  Vec3 center = Vec3::Zero(), u = Vec3::Zero(), v = Vec3::Zero(), climb = Vec3::Zero();
  Real begin = 0, sweep = 0;  ///< rad

  /// `share` from 0 to 1.
  Vec3 at(Real share) const;
};

/// How a line between two points meets a surface.
struct Wrap {
  enum class Kind {
    none,    ///< the line runs past it
    inside,  ///< one of the points lies in it
    held,    ///< it goes around where that lengthens the path least
    needed   ///< it goes around here
  };
  Kind kind = Kind::none;
  Arc way;          ///< on the surface, in its frame
  Real length = 0;  ///< m, of `way`

  bool touches() const { return kind == Kind::held || kind == Kind::needed; }  ///< whether `way` means anything
  Vec3 first() const { return way.at(0); }  ///< where it comes onto the surface, in its frame
  Vec3 last() const { return way.at(1); }   ///< where it leaves it
};

/// The way from a to b (in the surface's frame) that OpenSim takes around it. Cylinder and sphere: the shortest, on the
/// side that it is held on. Ellipsoid: see wrap_ellipsoid. An obstacle (Garner and Pandy 2000) is passed in its sense
/// as long as less than half a turn touches it. Inside a torus' ring the way is that around a cylinder along its tube
/// where the line comes nearest to it.
Wrap wrap_around(const WrapSurface& surface, const Vec3& a, const Vec3& b,
                 WrapSurface::Plane plane = WrapSurface::Plane::hybrid);

}  // namespace gracilis
