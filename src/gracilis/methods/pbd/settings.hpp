#pragma once

#include <gracilis/methods/predictor.hpp>
#include <gracilis/scene/setting_values.hpp>

namespace gracilis {

/// What tells where bones are.
enum class PbdCollision {
  fields,  ///< their distance fields
  voxels   ///< boxes that are full or empty (published)
};
/// The names of the choices, in their order.
constexpr std::array<std::string_view, 2> choices_of(PbdCollision) { return {"fields", "voxels"}; }

/// Which way a vertex that moved into a bone goes back.
enum class PbdPushBack {
  normal,  ///< the shortest way out
  entry    ///< the way that it came in (published)
};
/// The names of the choices, in their order.
constexpr std::array<std::string_view, 2> choices_of(PbdPushBack) { return {"normal", "entry"}; }

/// Of one muscle. Defaults are stable ones; what was published is the preset `pbd-2020`.
struct PbdSettings {
  int iterations = 3;            ///< per frame
  Real edge_stiffness = 1;       ///< 0 to 1, share of an error that the iterations of a frame correct
  Real angle_stiffness = 1;      ///< the same
  Real dihedral_limit = 0.05;    ///< largest motion by one projection of an angle, as a share of its edge; 0: off
  Real volume_stiffness = 1;     ///< the same as edge_stiffness
  bool fiber_anisotropy = true;  ///< eq. 5
  Predictor predictor = Predictor::carried;  ///< published: none
  Real tendon_length = 0.03;                 ///< m from attachments, graded from tendon to belly; 0: no tendons
  PbdCollision collision = PbdCollision::fields;
  int voxels = 64;  ///< along each axis of a bone's bounding box
  PbdPushBack push_back = PbdPushBack::normal;
  Real bone_margin = 0.0005;  ///< m
  bool bone_rest_gap = true;  ///< where there is less at rest, keep that
};

template <>
std::span<const Setting<PbdSettings>> setting_table();  ///< a row for each setting

}  // namespace gracilis
