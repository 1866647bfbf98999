#include <gracilis/strings/string_frames.hpp>

#include <gracilis/geometry/rotations.hpp>

#include <cmath>

namespace gracilis::strings {

namespace {

using Quaternion = Eigen::Quaterniond;

/// The turn that goes on from `turn` to where the direction `rest` becomes `now`, by the least rotation.
Quaternion aligned(const Quaternion& turn, const Vec3& rest, const Vec3& now) {
  return turn_from_to(turn * rest, now) * turn;
}

/// The angle of a rotation about an axis that it nearly leaves in place, in (-π, π].
Real twist_about(const Quaternion& rotation, const Vec3& axis) {
  return std::remainder(2 * std::atan2(rotation.vec().dot(axis), rotation.w()), 2 * pi);
}

}  // namespace

FiberFrames fiber_frames(const MuscleStrings& muscle, const StringState& state) {
  FiberFrames frames{Points(3, state.places.cols()), Eigen::Matrix4Xd(4, state.places.cols())};
  std::vector<Quaternion> turns(static_cast<std::size_t>(muscle.nodes));
  std::vector<Vec3> directions(turns.size());
  const std::size_t last = turns.size() - 1;
  for (Index s = 0; s < muscle.strings; ++s) {
    const auto string = static_cast<std::size_t>(s);
    const auto body = [&](Index b) { return Quaternion(state.bodies[static_cast<std::size_t>(b)].linear()); };
    const Quaternion origin = body(muscle.origin_bodies[string]), insertion = body(muscle.insertion_bodies[string]);
    Quaternion turn = origin;
    for (std::size_t i = 0; i <= last; ++i) {
      directions[i] = string_direction(muscle, state.places, s, static_cast<Index>(i));
      turns[i] = turn = aligned(turn, string_direction(muscle, muscle.taut, s, static_cast<Index>(i)), directions[i]);
    }
    const Quaternion end =
        aligned(insertion, string_direction(muscle, muscle.taut, s, muscle.nodes - 1), directions[last]);
    const Real twist = twist_about(end * turns[last].conjugate(), directions[last]);
    for (std::size_t i = 0; i <= last; ++i) {
      const Index node = static_cast<Index>(i), p = muscle.node(s, node);
      const Real share = static_cast<Real>(i) / static_cast<Real>(last);
      turns[i] = Eigen::AngleAxisd(share * twist, directions[i]) * turns[i];
      if (const Index held_by = body_holding(muscle, s, node); held_by >= 0) turns[i] = body(held_by);
      frames.turns.col(p) = turns[i].coeffs();
      frames.fibers.col(p) = state.places.col(p) + turns[i] * Vec3(muscle.fibers.col(p) - muscle.taut.col(p));
    }
  }
  return frames;
}

}  // namespace gracilis::strings
