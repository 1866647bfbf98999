#pragma once

#include <gracilis/strings/bone_distances.hpp>
#include <gracilis/strings/string_lanes.hpp>
#include <gracilis/strings/string_settings.hpp>

#include <optional>
#include <vector>

namespace gracilis::strings {

/// Keeps a node no nearer to a bone than it was at rest: the string may slide over it.
struct Slide {
  Index bone = 0;
  Real share = 0;     ///< of the node's support
  Real distance = 0;  ///< m, at rest
};

/// What holds one inner node of a string, measured in the capture pose.
struct NodeSupport {
  Vec3 normal = Vec3::Zero();  ///< unit, against the pull of the bent fiber; zero where it is straight
  std::vector<Slide> slides;
};

/// A muscle as strings from origin to insertion, constant during a run. Node i of string s is column s · nodes + i of
/// all matrices. World frame of the capture pose, m.
struct MuscleStrings {
  StringSettings settings;
  Index strings = 0;
  Index nodes = 0;                                     ///< of each string
  Points fibers;                                       ///< the fibers that the strings stand for
  Points taut;                                         ///< the strings, pulled tight over what holds the fibers
  std::vector<Real> lengths;                           ///< m, of each fiber
  std::vector<Index> origin_bodies, insertion_bodies;  ///< of each string's ends
  /// Nodes up to the first and from the second on go with the bodies of the ends; of each string.
  std::vector<Index> first_held, last_held;
  Eigen::MatrixXd shares;                     ///< bodies × nodes: how bodies carry a node, columns sum to 1
  Eigen::VectorXd ties;                       ///< per node: share of the tie's strength
  std::vector<NodeSupport> supports;          ///< per node
  Eigen::MatrixXd bone_distances;             ///< bones × nodes, m; beyond a field's reach a lower bound
  std::vector<std::vector<Index>> neighbors;  ///< of each string
  StringLanes lanes;                          ///< all of this for the vector kernel

  Index node(Index string, Index i) const { return string * nodes + i; }  ///< the i-th of a string
};

/// Whether a muscle is attached to several bodies: with one alone it just goes along, and needs no strings.
bool runs_between_bodies(const Muscle& muscle);

/// Lays strings along a muscle's fibers from attachment to attachment (those of the scene, or of the template) and
/// pulls them tight in the capture pose. Nothing for a muscle that has no fibers from an origin to an insertion.
/// Precondition: the scene is valid.
std::optional<MuscleStrings> muscle_strings(const Scene& scene, const Muscle& muscle, const BoneDistances& bones,
                                            const StringSettings& settings);

/// The body that an end of a string, or a part that turns back, goes with; -1 for a node that is free.
Index body_holding(const MuscleStrings& muscle, Index string, Index i);

/// The unit direction of a string at a node, by its neighbors.
Vec3 string_direction(const MuscleStrings& muscle, const Points& places, Index string, Index i);

}  // namespace gracilis::strings
