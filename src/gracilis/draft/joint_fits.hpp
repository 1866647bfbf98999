#pragma once

#include <gracilis/draft/body_frame.hpp>

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

/// Of each coordinate, the direction of the body that the dictionary names.
std::vector<Vec3> body_axes(const JointQuestion& question);

/// Numbers of the bones of these names on this side.
std::vector<std::size_t> bones_named(const FoundFolder& found, const std::vector<std::string>& names, BodySide side);

}  // namespace gracilis
