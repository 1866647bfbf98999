#pragma once

#include <gracilis/strings/muscle_strings.hpp>
#include <gracilis/strings/string_system.hpp>

#include <vector>

namespace gracilis::strings {

/// A support whose slides take more than the rest of this has no plane left.
inline constexpr Real least_plane_share = 0.01;

/// The distance that a node keeps to a bone, m: the gap at rest, or less.
Real kept_at_node(const MuscleStrings& muscle, std::size_t bone, Index node);
/// That of the middle of a segment between two nodes.
Real kept_at_middle(const MuscleStrings& muscle, std::size_t bone, Index node, Index other);

/// What acts on the nodes of a muscle's strings in one pose: tension, ties, supports, neighbors, bones. Forces are over
/// the tension, so in 1; stiffnesses in 1/m. Formulas: docs/mathematics.md, "Taut strings".
class NodeForces {
 public:
  /// All must outlive this.
  NodeForces(const MuscleStrings& muscle, const BoneDistances& bones, const std::vector<RigidTransform>& bodies);

  /// Neighbors pull towards where they were at the beginning of an iteration, so that strings do not wait for each
  /// other.
  void begin_iteration(const Points& places);
  /// The Gauss-Newton system of one string.
  void assemble(Index string, const Points& places, StringSystem& system);
  /// Says that no node of a string moved further than this since it was last assembled, m.
  void string_moved(Index string, Real distance) { travelled_[static_cast<std::size_t>(string)] += distance; }

  const MuscleStrings& muscle() const { return muscle_; }  ///< whose strings they are

 private:
  struct Node;
  /// Where a point was last asked for, and how far the bone was: nearer than that it cannot be before it has moved.
  struct Seen {
    Eigen::Vector3f place = Eigen::Vector3f::Zero();
    float distance = 0;
  };

  void find_clear_bones(Index string, const Points& places);
  bool bone_force(std::size_t bone, const Vec3& place, Real kept, Seen& seen, Real& depth, Vec3& normal) const;
  void hold(const Node& node, Index body, StringSystem& system) const;
  void tie(const Node& node, StringSystem& system) const;
  void support(const Node& node, StringSystem& system) const;
  void hold_among_neighbors(const Node& node, StringSystem& system) const;
  void keep_from_bones(const Node& node, const Points& places, StringSystem& system);

  const MuscleStrings& muscle_;
  const BoneDistances& bones_;
  const std::vector<RigidTransform>& bodies_;
  std::vector<Eigen::Isometry3f> to_bones_;            ///< from the world to each bone's capture frame
  Points tied_to_, support_places_, support_normals_;  ///< per node
  Points before_;                                      ///< places at the beginning of the iteration
  std::vector<Eigen::Matrix3d> section_turns_;         ///< of each cross-section, from the capture pose
  /// Bones × strings: how far all nodes of a string may travel before one is near the bone, m; and how far they did.
  Eigen::MatrixXd clear_;
  std::vector<Real> travelled_;
  std::vector<Seen> seen_nodes_, seen_middles_;  ///< bone by bone
};

}  // namespace gracilis::strings
