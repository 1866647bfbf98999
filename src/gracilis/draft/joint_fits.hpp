#pragma once

#include <gracilis/draft/body_frame.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace gracilis {

/// Where a joint is and about what it turns.
struct JointFit {
  Vec3 center = Vec3::Zero();
  std::vector<Vec3> axes;  ///< unit, of each coordinate, files' frame
  std::string how;
  Real certainty = 0;
};

/// Landmarks that say where a joint is instead: one its center, two its axis.
using JointOverrides = std::map<std::string, Points>;

/// What a fit may ask of.
struct JointQuestion {
  const FoundFolder& found;
  const std::vector<std::optional<BoneAxis>>& axes;
  const BodyFrame& frame;
  const KnownJoint& joint;
  BodySide side = BodySide::none;
};

/// Nothing where the surfaces do not show the joint.
std::optional<JointFit> fit_joint(const JointQuestion& question);

/// The same from landmarks (1 or 2 points); without a direction in them the axes are the body's.
JointFit joint_at(const Points& landmarks, const JointQuestion& question);

/// Numbers of the bones of these names on this side.
std::vector<std::size_t> bones_named(const FoundFolder& found, const std::vector<std::string>& names, BodySide side);

}  // namespace gracilis
