#pragma once

#include <gracilis/simulate/bone_space.hpp>
#include <gracilis/simulate/taut_way.hpp>
#include <gracilis/simulate/tracked_lines.hpp>

#include <vector>

namespace gracilis {

struct PlacedBones;

/// How a muscle's lines run, against the taut ways between their ends; neutral for a muscle without lines.
struct MuscleWay {
  Real length_ratio = 1;  ///< mean length of the lines over that at rest
  Real slack = 0;         ///< mean over lines of slack_of
  Real wrong_side = 0;    ///< share of the lines that pass a bone on another side than their taut way
};

/// A line beside its taut way.
struct LineBesideWay {
  Real length = 0;    ///< m, of the line
  Real way = 0;       ///< m, of the way
  Real turn = 0;      ///< rad, by which the way turns in all, in eight pieces
  Real standoff = 0;  ///< m, mean distance of the line's points from those at the same shares of the way
};
/// Of a line and its way, both from the same end, m.
LineBesideWay beside_way(const Points& line, const Points& way);

/// How much longer a line is than it must be, as a share, at least 0. It must be as many times longer than its way as
/// at rest, and, as it keeps the distance at which it ran beside the way at rest, longer by that distance times the
/// angle by which the way turns more than at rest (as parallel curves are; Steiner 1840). What is no longer than at
/// rest is not too long either: it pulls no more and may bend. 0 for lines without length.
Real slack_of(const LineBesideWay& now, const LineBesideWay& rest);

/// Measures the ways that muscles take.
class WayMeasures {
 public:
  /// `exact` are the distances to the scene's bones. All must outlive this; `tracker` may be null.
  WayMeasures(const Scene& scene, const std::vector<SignedDistance>& exact, const FiberTracker* tracker);
  WayMeasures(const WayMeasures&) = delete;
  WayMeasures& operator=(const WayMeasures&) = delete;

  /// Takes the taut ways on to a pose; they remember every pose they went through.
  void follow(const Pose& pose) { ways_.follow(pose); }

  const TautWays& taut() const { return ways_; }

  /// Per muscle, in the pose that the ways were taken to. `fibers` are what the tracker says of the frame, or empty,
  /// which asks it.
  std::vector<MuscleWay> measure(const Frame& frame, const std::vector<MuscleFibers>& fibers) const;

 private:
  MuscleWay measure(std::size_t muscle, const Polylines& lines, const PlacedBones& bones) const;

  const FiberTracker* tracker_;
  BoneSpace space_;
  TrackedLines lines_;
  TautWays ways_;
  std::vector<std::vector<LineBesideWay>> rest_;  ///< per muscle and line
};

}  // namespace gracilis
