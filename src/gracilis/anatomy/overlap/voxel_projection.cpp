#include <gracilis/anatomy/overlap/voxel_projection.hpp>

#include <gracilis/core/parallel.hpp>

#include <algorithm>
#include <utility>

namespace gracilis {

BoneVoxels bone_voxels(const Scene& scene, int boxes) {
  std::vector<VoxelSolid> solids;
  for (const Bone& bone : scene.bones) solids.emplace_back(bone.surface, boxes);
  return std::make_shared<const std::vector<VoxelSolid>>(std::move(solids));
}

VoxelProjection::VoxelProjection(const Scene& scene, const Muscle& muscle, const std::vector<Index>& fixed_body,
                                 BoneVoxels voxels, bool rest_gap)
    : voxels_(std::move(voxels)) {
  for (std::size_t b = 0; b < scene.bones.size(); ++b) {
    PerBone bone{scene.bones[b].body, {}};
    for (Index v = 0; v < muscle.surface.vertex_count(); ++v) {
      const bool is_free = fixed_body[static_cast<std::size_t>(v)] < 0;
      bone.is_kept_out.push_back(is_free && !(rest_gap && (*voxels_)[b].contains(muscle.surface.vertices.col(v))));
    }
    bones_.push_back(std::move(bone));
  }
}

/// Calls place(bone, to_bone, vertex, point in the bone's frame) of every vertex in a bone for its new place in that
/// frame.
template <class Place>
Index VoxelProjection::replace_inside(const Pose& pose, Points& points, const Place& place) const {
  Index found = 0;
  for (std::size_t b = 0; b < bones_.size(); ++b) {
    const PerBone& bone = bones_[b];
    const VoxelSolid& solid = (*voxels_)[b];
    const RigidTransform& to_world = pose.bodies[static_cast<std::size_t>(bone.body)];
    const RigidTransform to_bone = to_world.inverse();
    std::vector<char> touched(bone.is_kept_out.size(), 0);
    parallel_for(static_cast<Index>(touched.size()), 1024, [&](Index begin, Index end) {
      for (Index v = begin; v < end; ++v) {
        if (!bone.is_kept_out[static_cast<std::size_t>(v)]) continue;
        const Vec3 in_bone = to_bone * Vec3(points.col(v));
        if (!solid.contains(in_bone)) continue;
        points.col(v) = to_world * place(b, to_bone, v, in_bone);
        touched[static_cast<std::size_t>(v)] = 1;
      }
    });
    found += static_cast<Index>(std::count(touched.begin(), touched.end(), 1));
  }
  return found;
}

Index VoxelProjection::push_out(const Pose& pose, Points& points) const {
  return replace_inside(pose, points, [&](std::size_t bone, const RigidTransform&, Index, const Vec3& in_bone) {
    return (*voxels_)[bone].nearest_empty(in_bone);
  });
}

Index VoxelProjection::take_back(const Pose& pose, const Points& began, Points& points) const {
  return replace_inside(pose, points,
                        [&](std::size_t bone, const RigidTransform& to_bone, Index v, const Vec3& in_bone) {
                          return (*voxels_)[bone].first_empty(in_bone, to_bone * Vec3(began.col(v)));
                        });
}

Index VoxelProjection::take_along(const Pose& last, const Pose& now, const Points& before, Points& points) const {
  return replace_inside(now, points, [&](std::size_t bone, const RigidTransform&, Index v, const Vec3&) -> Vec3 {
    const auto body = static_cast<std::size_t>(bones_[bone].body);
    return last.bodies[body].inverse() * Vec3(before.col(v));
  });
}

}  // namespace gracilis
