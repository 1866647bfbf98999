#pragma once

#include <gracilis/core/types.hpp>

namespace gracilis {

/// How a body moves per unit of something: the velocity of its point at the world's origin, and its turning, both in
/// the world's directions.
struct Twist {
  Vec3 velocity = Vec3::Zero();
  Vec3 turning = Vec3::Zero();

  Vec3 velocity_at(const Vec3& place) const { return velocity + turning.cross(place); }  ///< m/s
};

}  // namespace gracilis
