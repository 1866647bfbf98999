#pragma once

#include <gracilis/strings/muscle_strings.hpp>

namespace gracilis::strings {

/// A cross-section: the nodes of equal number of all strings.
struct StringSection {
  Vec3 center = Vec3::Zero();     ///< mean of its nodes
  Vec3 direction = Vec3::Zero();  ///< sum of the strings' unit directions
  Real spread = 0;                ///< sum of its nodes' squared distances from the center, m²
};

/// Section i of the strings at `places`.
StringSection string_section(const MuscleStrings& muscle, const Points& places, Index i);

/// How each cross-section has turned from the capture pose: the rotation
/// that best takes its nodes about their center and its mean direction to where they are (Kabsch 1976).
std::vector<Eigen::Matrix3d> section_turns(const MuscleStrings& muscle, const Points& places);

}  // namespace gracilis::strings
