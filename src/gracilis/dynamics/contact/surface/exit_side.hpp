#pragma once

#include <gracilis/dynamics/contact/surface/contact_world.hpp>

namespace gracilis {

/// Which faces of a surface a particle may come out through that lies in it at rest: those on the side where its
/// surroundings lie nearest to the outside there. In a thin sheet the far side may be the nearer one for single
/// particles, or becomes so while both move, and would hold them on the wrong side.
struct ExitSide {
  const ContactSurface& surface;  ///< that the particle lies in
  const Eigen::Matrix3Xf& rest;   ///< its shape at rest, m
  const Eigen::Matrix3Xf& ways;   ///< per particle, see SurfacePair

  /// Whether the particle has a side at all.
  bool is_told(Index particle) const { return ways.cols() > 0 && !ways.col(particle).isZero(0); }

  /// Precondition: is_told(particle).
  bool is_exit(Index particle, Index face) const {
    const Eigen::Vector3f a = rest.col(surface.faces(0, face)), b = rest.col(surface.faces(1, face)),
                          c = rest.col(surface.faces(2, face));
    const Eigen::Vector3f area = (b - a).cross(Eigen::Vector3f(c - a));
    return area.dot(ways.col(particle)) > least_cosine * area.norm();
  }

  /// From `face` to the face nearest to p, where the particle is; to its nearest exit where it lies behind `face`
  /// still.
  NearestFace walk(Index particle, const Eigen::Vector3f& p, Index face, const Particles& target) const {
    if (!is_told(particle) || !is_behind(p, face, target)) return walk_to_nearest(p, surface, face, target);
    return walk_to_nearest(p, surface, face, target, [&](Index next) { return is_exit(particle, next); });
  }

  /// A rim belongs to both sides; what faces the other way by more than 120 degrees is the far side.
  static constexpr float least_cosine = -0.5f;

 private:
  bool is_behind(const Eigen::Vector3f& p, Index face, const Particles& target) const {
    return face_area(surface, face, target).dot(p - target.position(surface.faces(0, face))) < 0;
  }
};

/// Of a pair: where particles of the first come out of the second, and the other way.
inline ExitSide exit_of_first(const ContactWorld& world, const SurfacePair& pair) {
  const auto second = static_cast<std::size_t>(pair.second);
  return {world.surfaces[second], world.rest[second], pair.first_ways};
}
/// The other way: where particles of the second come out of the first.
inline ExitSide exit_of_second(const ContactWorld& world, const SurfacePair& pair) {
  const auto first = static_cast<std::size_t>(pair.first);
  return {world.surfaces[first], world.rest[first], pair.second_ways};
}

}  // namespace gracilis
