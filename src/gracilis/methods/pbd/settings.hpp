#pragma once

#include <gracilis/scene/setting_values.hpp>

namespace gracilis {

/// Where free vertices are when a frame begins.
enum class PbdCarry {
  none,   ///< where they were, so that they follow through constraints alone (published)
  bodies  ///< carried by a blend of the bodies' motions since then
};
constexpr std::array<std::string_view, 2> choices_of(PbdCarry) { return {"none", "bodies"}; }

/// Of one muscle. Defaults are stable ones; what was published is the preset `pbd-2020`.
struct PbdSettings {
  int iterations = 3;            ///< per frame
  Real edge_stiffness = 1;       ///< 0 to 1, share of an error that the iterations of a frame correct
  Real angle_stiffness = 1;      ///< the same
  Real hinge_limit = 0.05;       ///< largest motion by one projection of an angle, as a share of its edge; 0: off
  Real volume_stiffness = 1;     ///< the same as edge_stiffness
  bool fiber_anisotropy = true;  ///< eq. 5
  PbdCarry carry = PbdCarry::bodies;
  Real tendon_length = 0.03;  ///< m from attachments, graded from tendon to belly; 0: no tendons
  Real bone_margin = 0.0005;  ///< m
  bool bone_rest_gap = true;  ///< where there is less at rest, keep that
};

template <>
std::span<const Setting<PbdSettings>> setting_table();

}  // namespace gracilis
