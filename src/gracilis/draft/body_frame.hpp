#pragma once

#include <gracilis/draft/found_surfaces.hpp>

#include <optional>
#include <string>
#include <vector>

namespace gracilis {

/// The line along a long bone, from its near end (towards the trunk) to its far one.
struct BoneAxis {
  Vec3 near = Vec3::Zero(), far = Vec3::Zero();

  Vec3 direction() const { return (far - near).normalized(); }  ///< unit, from near to far
  Real length() const { return (far - near).norm(); }           ///< m
  /// 0 at the near end, 1 at the far one.
  Real share(const Vec3& p) const { return (p - near).dot(far - near) / (far - near).squaredNorm(); }
};

/// Of each bone; none where it is not long.
std::vector<std::optional<BoneAxis>> bone_axes(const FoundFolder& found);

/// How the body stands in the files' frame.
struct BodyFrame {
  Vec3 anterior = Vec3::UnitX(), superior = Vec3::UnitY();  ///< unit, at right angles
  std::string how;
  Real certainty = 0;

  Vec3 right() const { return anterior.cross(superior); }  ///< unit
  /// "right", "-anterior" ... of the body's right half; on the left one what turns about anterior or superior turns the
  /// other way, so that values keep their meaning.
  Vec3 named(const std::string& direction, BodySide side) const;
};

/// The turn that brings the dictionary's places of the bones nearest to where they lie (Kabsch 1976); where it is
/// nearly one of the frame's axes, that axis. Where they lie nearly on a line, vertebrae tell the front.
BodyFrame body_frame(const FoundFolder& found, const std::vector<std::optional<BoneAxis>>& axes);

}  // namespace gracilis
