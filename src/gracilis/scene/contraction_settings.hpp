#pragma once

#include <gracilis/scene/setting_table.hpp>

namespace gracilis {

/// How inner fibers are carried onto the surface.
enum class SurfacePaths {
  along_fibers,   ///< one way from the vertex nearest to each fiber's begin to that nearest to its end, at costs that
                  ///< grow with the angle to the fiber direction and with the distance from the fiber
  nearest_joined  ///< published: the vertices nearest to each fiber's points, joined by shortest ways
};
/// The names of the choices, in their order.
constexpr std::array<std::string_view, 2> choices_of(SurfacePaths) { return {"along_fibers", "nearest_joined"}; }

/// How one muscle contracts. Defaults, units and ranges: its table.
struct ContractionSettings {
  Real threshold = 0.02;     ///< activation above which a muscle contracts
  Real shortest = 0.7;       ///< least share of its length at rest that a segment aims at
  Real stiffness = 50;       ///< N/m, tension per width of the surface over relative excess length
  bool spread = true;        ///< all edges along the fibers pull, not the segments of surface fibers only
  bool two_sided = false;    ///< edges hold the length that they aim at both ways instead of pulling only
  bool ramp = true;          ///< the stiffness rises with the activation instead of being full
  bool area_scaling = true;  ///< a segment pulls for the area nearest to it, not once for each fiber over it
  SurfacePaths paths = SurfacePaths::along_fibers;
  int segments = 100;         ///< of each fiber that is carried onto the surface
  bool reject_across = true;  ///< segments far off the fiber direction are left out
};

/// The share of its length at rest that a segment aims at, max(1 - a, shortest) (Havlíček 2024, eq. 5.11).
inline Real contracted_share(const ContractionSettings& settings, Real activation) {
  return activation < 1 - settings.shortest ? 1 - activation : settings.shortest;
}

template <>
std::span<const Setting<ContractionSettings>> setting_table();  ///< a row for each setting

}  // namespace gracilis
