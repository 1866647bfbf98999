#include <gracilis/methods/pbd/settings.hpp>

#include <gracilis/methods/shared_rows.hpp>

namespace gracilis {

template <>
std::span<const Setting<PbdSettings>> setting_table() {
  using S = PbdSettings;
  static const Setting<S> table[] = {
      {"iterations", &S::iterations, "", 1, 100000, "How often all constraints are projected per frame."},
      {"edge_stiffness", &S::edge_stiffness, "", 0, 1,
       "Share of an edge's error that the iterations of a frame correct when nothing else pulls at it."},
      {"angle_stiffness", &S::angle_stiffness, "", 0, 1,
       "The same for the angle between two triangles, which is measured by arccos as published."},
      {"hinge_limit", &S::hinge_limit, "", 0, 10,
       "Largest motion by one projection of an angle, as a share of its edge's length; 0 is none, and lets vertices "
       "beside attachments fly."},
      {"volume_stiffness", &S::volume_stiffness, "", 0, 1, "The same share of the volume's error."},
      {"fiber_anisotropy", &S::fiber_anisotropy, "", 0, 0,
       "Correct an edge by 1 - |u·v| of its error, u its direction and v that of the nearest fiber."},
      {"carry", &S::carry, "", 0, 0,
       "Where free vertices are when a frame begins: 'none' leaves them where they were, as published, 'bodies' "
       "carries them by a blend of the motions of the bodies that the muscle is attached to."},
      {"tendon_length", &S::tendon_length, "m", 0, 1,
       "Distance from the attachments over which that blend is graded from tendon to belly; 0 grades nothing."},
      bone_margin_row<S>(),
      bone_rest_gap_row<S>(),
  };
  return table;
}

}  // namespace gracilis
