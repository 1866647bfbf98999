#pragma once

#include <gracilis/geometry/voxel_solid.hpp>
#include <gracilis/scene/pose.hpp>
#include <gracilis/scene/scene.hpp>

#include <memory>
#include <vector>

namespace gracilis {

/// Solids of all bones of a scene, in the capture pose.
using BoneVoxels = std::shared_ptr<const std::vector<VoxelSolid>>;

/// `boxes` along each axis of every bone's bounding box.
BoneVoxels bone_voxels(const Scene& scene, int boxes);

/// What BoneProjection does by distance fields, by boxes that are full or empty. They tell no distance, so there is no
/// margin.
class VoxelProjection {
 public:
  /// With `rest_gap` a bone leaves those vertices alone that are in its boxes in the capture pose. `fixed_body` is -1
  /// for free vertices.
  VoxelProjection(const Scene& scene, const Muscle& muscle, const std::vector<Index>& fixed_body, BoneVoxels voxels,
                  bool rest_gap);

  /// As BoneProjection: the shortest way out.
  Index push_out(const Pose& pose, Points& points) const;

  /// As BoneProjection, in steps of a box.
  Index take_back(const Pose& pose, const Points& began, Points& points) const;

  /// As BoneProjection.
  Index take_along(const Pose& last, const Pose& now, const Points& before, Points& points) const;

 private:
  template <class Place>
  Index replace_inside(const Pose& pose, Points& points, const Place& place) const;

  struct PerBone {
    Index body = 0;
    std::vector<char> is_kept_out;  ///< per vertex
  };
  BoneVoxels voxels_;
  std::vector<PerBone> bones_;
};

}  // namespace gracilis
