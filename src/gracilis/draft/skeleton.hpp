#pragma once

#include <gracilis/draft/guess.hpp>
#include <gracilis/draft/joint_landmarks.hpp>

#include <string>
#include <vector>

namespace gracilis {

struct DraftAxis {
  std::string coordinate;
  Vec3 direction = Vec3::UnitZ();  ///< files' frame
  Real capture = 0, range_min = -pi, range_max = pi;
  std::optional<Real> shown;
};

struct DraftJoint {
  std::string name, parent, child;  ///< bodies
  Vec3 center = Vec3::Zero();
  std::vector<DraftAxis> axes;
  Guess guess, capture_guess;
};

/// Which bones move as one, and how against the others.
struct Skeleton {
  std::vector<std::optional<BoneAxis>> axes;  ///< of the folder's bones
  BodyFrame frame;
  std::vector<std::string> bodies;  ///< of the folder's bones
  std::vector<DraftJoint> joints;   ///< parents before children
  std::vector<Guess> guesses;       ///< of what was fixed for want of better
  std::string root;

  /// The body that a known segment (by name and side) goes with, whether it has bones here or not.
  std::string body_of(const std::string& segment, BodySide side) const;
  /// Joints between the root and this body.
  int depth(const std::string& body) const;
  /// The joint that moves this body; null of the root.
  const DraftJoint* joint_of(const std::string& child) const;

  std::map<std::string, std::string> body_of_segment;  ///< by the segment's name and side's ending
};

/// Joints are fitted where both of the segments are there (and a muscle that moves it, where it asks for one); segments
/// without are fixed to their parents. `overrides`: landmarks of joints, by their names ("hip_r").
Skeleton find_skeleton(const FoundFolder& found, const JointOverrides& overrides);

}  // namespace gracilis
