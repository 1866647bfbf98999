#pragma once

#include <gracilis/draft/joint_fits.hpp>

#include <map>
#include <string>

namespace gracilis {

/// Landmarks that say where a joint is instead: one its center, two its axis.
using JointOverrides = std::map<std::string, Points>;

/// The joint with its center at the middle of landmarks (1 or 2 points) and, of two, its first axis along their line;
/// the rest is as fitted, or else by the body's directions. Throws ConfigurationError where two lie at one place.
JointFit joint_at(const Points& landmarks, const JointQuestion& question);

}  // namespace gracilis
