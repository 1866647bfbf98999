#pragma once

#include <gracilis/simulate/bone_space.hpp>

#include <vector>

namespace gracilis {

/// The bones where they are at one instant.
struct PlacedBones {
  /// Where these bodies have them.
  PlacedBones(const BoneSpace& bones, const std::vector<RigidTransform>& bodies);

  /// Distance (m) at a point of the world, and its gradient in the bone's frame.
  FieldSample sample(std::size_t bone, const Vec3& p) const { return space.sample(bone, to_local[bone] * p); }
  /// Turns a direction from the bone's frame to the world's.
  Vec3 in_world(std::size_t bone, const Eigen::Vector3f& direction) const {
    return to_local[bone].linear().transpose() * direction.cast<Real>();
  }

  const BoneSpace& space;
  std::vector<RigidTransform> to_local;  ///< per bone: from the world to its frame
};

/// Pulls a string tight among the bones; its ends stay. In every sweep each inner point goes towards the middle of its
/// neighbors (successive over-relaxation with the factor that is best in free space; Young 1954) and out of the bones
/// again, which leads to a shortest way on its side of them: no point moves further at once than its distance from the
/// bones, or 2 mm near them, and one that enters a bone leaves it where it entered. Ends when no point moves by more
/// than 0.05 mm, or after `sweeps`.
void pull_tight(const PlacedBones& bones, Points& string, int sweeps);

/// Carries a string's inner points by the bones' motions, each bone weighing as one over the squared distance from it.
/// `bones` are placed where they are before; `motions` are per bone. Without bones nothing is carried.
void carry_string(const PlacedBones& bones, const std::vector<RigidTransform>& motions, Points& string);

}  // namespace gracilis
