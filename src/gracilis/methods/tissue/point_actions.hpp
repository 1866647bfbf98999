#pragma once

#include <gracilis/geometry/field_spline.hpp>
#include <gracilis/methods/tissue/point_energy.hpp>
#include <gracilis/methods/tissue/total_energy.hpp>

namespace gracilis::tissue {

/// What acts on a point of the surface.
enum class PointActor { attachment, fascia, bone, muscle };

/// Calls act(PointActor, number of the body, bone or muscle, PointState) for all that acts on point v at the place p.
template <class Act>
void for_each_action(const PreparedTissue& muscle, const Surroundings& around, std::size_t v, const Vec3& p,
                     const Act& act) {
  const SurfacePoint& point = muscle.points[v];
  const TissueSettings& settings = muscle.settings;
  if (v < around.drawn_by.size() && around.drawn_by[v] >= 0)
    act(PointActor::muscle, around.drawn_by[v],
        spring(p - around.drawn_to.col(static_cast<Index>(v)), around.drawn_stiffness[static_cast<Index>(v)]));
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
  for (const NearBone& near : bones_near(around, static_cast<Index>(v))) {
    if ((p - around.seen.col(static_cast<Index>(v))).squaredNorm() < near.clear * near.clear) continue;
    const BoneGap& bone = muscle.bones[static_cast<std::size_t>(near.bone)];
    const auto body = static_cast<std::size_t>(bone.body);
    const PreciseSample found = sample_spline_precise(bone.field.grid, around.inverses[body] * p);
    if (found.distance < bone.gaps[v])
      act(PointActor::bone, near.bone,
          contact(found.distance, around.bodies[body].linear() * found.gradient, bone.gaps[v],
                  settings.contact_stiffness * point.area));
  }
  for (Index i = around.planes_begin[v]; i < around.planes_begin[v + 1]; ++i) {
    const ContactPlane& plane = around.planes[static_cast<std::size_t>(i)];
    const Real distance = plane.normal.dot(p) - plane.least;
    if (distance < 0)
      act(PointActor::muscle, plane.muscle,
          contact(distance, plane.normal, 0, plane.share * settings.neighbor_stiffness * point.vertex_area));
  }
}

}  // namespace gracilis::tissue
