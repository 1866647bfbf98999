#include <gracilis/methods/tissue/forces.hpp>

#include <gracilis/methods/tissue/point_energy.hpp>

namespace gracilis::tissue {

Wrench attachment_wrench(const PreparedTissue& muscle, const Surroundings& around, const Points& nodes,
                         AttachmentEnd end) {
  Wrench sum;
  for (std::size_t v = 0; v < muscle.points.size(); ++v) {
    const SurfacePoint& point = muscle.points[v];
    if (point.held_by < 0 || point.end != end) continue;
    const Vec3 held = around.held.col(static_cast<Index>(v));
    const Vec3 force =
        spring(point_at(muscle, v, nodes) - held, muscle.settings.attachment_stiffness * point.area).gradient;
    sum.force += force;
    sum.moment += held.cross(force);
  }
  return sum;
}

}  // namespace gracilis::tissue
