#pragma once

#include <gracilis/scene/pose.hpp>
#include <gracilis/strings/muscle_strings.hpp>

#include <vector>

namespace gracilis::strings {

/// Where a bone's distance has a smaller gradient than this it has no direction: within it, or beyond its field.
inline constexpr Real least_slope = 0.1;

/// How strings come to rest in single precision, in which less is lost.
inline constexpr Relaxation settling_nearly{300, 3e-7, 80};
/// A string that would still move further then, m, has no place to rest; less matters nothing to its derivative.
inline constexpr Real unsettled_move = 5e-6;

/// Where a muscle's strings are, and the pose that they were relaxed in.
struct StringState {
  Points places;  ///< nodes, world, m
  std::vector<RigidTransform> bodies;
};

/// The strings of the capture pose, pulled tight from their fibers: only supports and bones hold them.
Points pulled_tight(const MuscleStrings& muscle, const BoneDistances& bones);

/// The state in the capture pose.
StringState capture_state(const MuscleStrings& muscle, std::size_t bodies);

/// Moves the strings to a pose, in steps that turn no body by more than `step_turn`. Each string minimizes its energy
/// (docs/mathematics.md, "Taut strings"): Gauss-Newton steps, begun where the bodies carry its nodes. The result
/// depends on the way of the poses where a string has two equilibria.
void follow(const MuscleStrings& muscle, const BoneDistances& bones, const Pose& pose, StringState& state);

/// Lets the strings come to rest in the pose that they are in, which `follow` does not wait for. Returns per string
/// whether it did not.
std::vector<char> settle(const MuscleStrings& muscle, const BoneDistances& bones, StringState& state);

/// The same in single precision: to some micrometres, which derivatives do not notice, where differences of lengths
/// between near poses do.
std::vector<char> settle_nearly(const MuscleStrings& muscle, const BoneDistances& bones, StringState& state);

}  // namespace gracilis::strings
