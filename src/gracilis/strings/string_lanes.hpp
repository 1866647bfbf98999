#pragma once

#include <gracilis/core/types.hpp>

#include <array>
#include <vector>

namespace gracilis::strings {

struct MuscleStrings;

/// Three numbers per place.
using LanePoints = std::array<std::vector<float>, 3>;

/// The constant part of a muscle's strings as the vector kernel reads it: strings side by side, so that each lane has a
/// string of its own. Number i · width + s belongs to node i of string s; what is beyond the last string repeats it.
/// Capture pose, m, seen from `center`, so that single precision suffices.
struct StringLanes {
  Index strings = 0, nodes = 0;
  Index width = 0;  ///< strings, rounded up to whole groups of lanes
  Vec3 center = Vec3::Zero();

  std::vector<float> tension, node_length;  ///< per string: stiffness of a segment, 1/m, and what a node stands for, m
  std::vector<Index> bodies;                ///< those that carry any node
  std::vector<std::vector<float>> shares;   ///< of each of these; 1 for the one that holds a node
  std::vector<float> free;                  ///< 1 for nodes that no body holds, otherwise 0

  LanePoints taut, fiber, normal;  ///< of MuscleStrings; no normal where nothing supports
  std::vector<float> tie, plane_share;

  struct Bone {
    std::vector<float> kept, kept_middle;  ///< m, to be kept at a node and at the middle after it
    std::vector<float> slide_share, slide_distance;
    std::vector<float> acts_within;  ///< m: farther away the bone does nothing to a node
  };
  std::vector<Bone> bones;

  std::vector<float> neighbor_weight;  ///< number j · width + s: what string j counts among the neighbors of string s
  std::vector<float>
      neighbor_weight_of;     ///< number j · width + s: what string s counts among the neighbors of string j
  LanePoints from_neighbors;  ///< from their mean place
  LanePoints from_section;    ///< from the mean place of all strings' nodes of this number; zero beyond the last
  std::vector<std::vector<Real>> section_shares;   ///< mean shares of `bodies`, per node
  std::vector<Eigen::Vector3f> section_direction;  ///< mean of the strings' directions, times the section's spread, m²
};

/// Precondition: everything else of the muscle is known.
StringLanes string_lanes(const MuscleStrings& muscle);

}  // namespace gracilis::strings
