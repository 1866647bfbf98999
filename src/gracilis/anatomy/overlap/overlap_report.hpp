#pragma once

#include <gracilis/scene/scene.hpp>

#include <string>
#include <vector>

namespace gracilis {

/// How two muscles overlap in the capture pose, for people to read.
struct MuscleOverlap {
  std::string first, second;
  Index first_vertices = 0, second_vertices = 0;  ///< of the one inside the other
  Real first_deepest = 0, second_deepest = 0;     ///< m
  bool is_through = false;                        ///< one passes through the other

  Real deepest() const { return first_deepest > second_deepest ? first_deepest : second_deepest; }  ///< m, of either
};

/// A muscle of which free vertices lie inside a bone in the capture pose.
struct MuscleInBone {
  std::string muscle, bone;
  Index vertices = 0;
  Real deepest = 0;  ///< m
};

/// How a scene's muscles lie in each other and in bones in the capture pose.
struct OverlapReport {
  std::vector<MuscleOverlap> pairs;    ///< the deepest first
  Index vertices = 0;                  ///< that lie in at least one other muscle
  Index of_vertices = 0;               ///< of all muscles
  std::vector<MuscleInBone> in_bones;  ///< the deepest first
};

/// By exact distances (rest_overlap.hpp); takes about a second for 40,000 vertices. Precondition: the scene is valid.
OverlapReport report_overlaps(const Scene& scene);

/// What a user should know about it, one line each: what lies more than 1 mm deep in bones, how much overlaps and where
/// most, and which muscles pass through each other. Empty where nothing does.
std::vector<std::string> overlap_warnings(const OverlapReport& report);

}  // namespace gracilis
