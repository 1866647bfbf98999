#pragma once

#include <gracilis/strings/muscle_strings.hpp>

namespace gracilis::strings {

/// How each cross-section (the nodes of equal number of all strings) has turned from the capture pose: the rotation
/// that best takes its nodes about their center and its mean direction to where they are (Kabsch 1976).
std::vector<Eigen::Matrix3d> section_turns(const MuscleStrings& muscle, const Points& places);

}  // namespace gracilis::strings
