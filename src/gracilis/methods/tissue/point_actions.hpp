#pragma once

#include <gracilis/methods/tissue/bone_contact.hpp>
#include <gracilis/methods/tissue/point_energy.hpp>
#include <gracilis/methods/tissue/total_energy.hpp>

namespace gracilis::tissue {

/// What acts on a point of the surface.
enum class PointActor { attachment, fascia, contact };

/// Calls act(PointActor, body or (contact) number of the bone, PointState) for all that acts on point v at the place p.
template <class Act>
void for_each_action(const PreparedTissue& muscle, const Surroundings& around, std::size_t v, const Vec3& p,
                     const Act& act) {
  const SurfacePoint& point = muscle.points[v];
  const TissueSettings& settings = muscle.settings;
  if (point.held_by >= 0) {
    act(PointActor::attachment, point.held_by,
        spring(p - around.held.col(static_cast<Index>(v)), settings.attachment_stiffness * point.area));
    return;
  }
  for (Index t = point.ties_begin; t < point.ties_end; ++t) {
    const Tie& each = muscle.ties[static_cast<std::size_t>(t)];
    act(PointActor::fascia, each.body,
        tie(p - around.tied.col(t), around.gliding.col(t), each.stiffness, settings.fascia_yield));
  }
  for (Index i = around.near_begin[v]; i < around.near_begin[v + 1]; ++i) {
    const NearBone& near = around.near[static_cast<std::size_t>(i)];
    if ((p - around.seen.col(static_cast<Index>(v))).squaredNorm() < near.clear * near.clear) continue;
    const BoneGap& bone = muscle.bones[static_cast<std::size_t>(near.bone)];
    const auto body = static_cast<std::size_t>(bone.body);
    const BoneDistance found = bone_distance(*bone.field, around.inverses[body] * p);
    if (found.distance < bone.gaps[v])
      act(PointActor::contact, near.bone,
          contact(found.distance, around.bodies[body].linear() * found.gradient, bone.gaps[v],
                  settings.contact_stiffness * point.area));
  }
}

}  // namespace gracilis::tissue
