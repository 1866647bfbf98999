#pragma once

#include <gracilis/geometry/polylines.hpp>
#include <gracilis/scene/pose.hpp>
#include <gracilis/simulate/bone_space.hpp>
#include <gracilis/simulate/tracked_lines.hpp>

#include <span>
#include <vector>

namespace gracilis {

/// A string between two points that move with bodies, pulled tight among the bones.
struct TautWay {
  EndBodies ends;
  Vec3 rest_first, rest_last;  ///< where the ends are in the capture pose
  Points points;               ///< where the string is now, world frame
};

/// Strings that begin in the capture pose as some lines do and follow the bones from there in small steps, so that each
/// keeps its side of every bone. They depend on the poses alone, never on how muscles are deformed.
class TautWays {
 public:
  /// Pulls a string tight from each of the lines, in the capture pose. The space must outlive this.
  TautWays(const BoneSpace& space, std::size_t body_count, const std::vector<MuscleLines>& lines);

  /// Goes on to this pose, by a screw motion of each body from the last one, in steps in which no body turns against
  /// another by more than 2 degrees or slides by more than 5 mm. Deterministic for any number of threads; the same
  /// poses in the same order give the same strings.
  void follow(const Pose& pose);

  /// The strings of a muscle, one per line.
  std::span<const TautWay> of(std::size_t muscle) const {
    return std::span(ways_).subspan(offsets_[muscle], offsets_[muscle + 1] - offsets_[muscle]);
  }
  /// Where bodies are now.
  const std::vector<RigidTransform>& bodies() const { return bodies_; }

 private:
  const BoneSpace& space_;
  std::vector<RigidTransform> bodies_;
  std::vector<TautWay> ways_;         ///< of all muscles, one after the other
  std::vector<std::size_t> offsets_;  ///< per muscle: where its ways begin
};

}  // namespace gracilis
