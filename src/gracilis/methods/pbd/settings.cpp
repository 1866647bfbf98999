#include <gracilis/methods/pbd/settings.hpp>

#include <gracilis/geometry/voxel_solid.hpp>
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
      {"hinge_limit", &S::dihedral_limit, "", 0, 10,
       "Largest motion by one projection of an angle, as a share of its edge's length; 0 is none, and lets vertices "
       "beside attachments fly."},
      {"volume_stiffness", &S::volume_stiffness, "", 0, 1, "The same share of the volume's error."},
      {"fiber_anisotropy", &S::fiber_anisotropy, "", 0, 0,
       "Correct an edge by 1 - |u·v| of its error, u its direction and v that of the nearest fiber."},
      predictor_row<S>(),
      tendon_length_row<S>(),
      {"collision", &S::collision, "", 0, 0,
       "What tells where bones are: 'fields' their distance fields, 'voxels' boxes that are full or empty, as "
       "published; "
       "by these no 'bone_margin' is kept, and with 'bone_rest_gap' a bone leaves vertices alone that are in its boxes "
       "at "
       "rest."},
      {"voxels", &S::voxels, "", 1, VoxelSolid::most_boxes, "Boxes along each axis of a bone's bounding box.", true},
      {"push_back", &S::push_back, "", 0, 0,
       "Which way a vertex that moved into a bone goes back: 'normal' the shortest out, 'entry' the way that it came "
       "in, "
       "as published."},
      bone_margin_row<S>(),
      bone_rest_gap_row<S>(),
  };
  return table;
}

}  // namespace gracilis
