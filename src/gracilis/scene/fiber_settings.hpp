#pragma once

#include <gracilis/scene/setting_table.hpp>

namespace gracilis {

/// How fibers run through the unit cube that is mapped into a muscle; its third axis leads from origin to insertion.
enum class FiberTemplate {
  parallel,  ///< straight along the cube
  pennate,   ///< straight, at an angle to the cube's axis
  curved,    ///< arcs that bulge to one side
  fan        ///< converge towards the insertion
};
/// The names of the choices, in their order.
constexpr std::array<std::string_view, 4> choices_of(FiberTemplate) { return {"parallel", "pennate", "curved", "fan"}; }

/// Where fibers end.
enum class FiberEnds {
  automatic,    ///< on aponeuroses where these are known or attachments are spread along the belly as such are
  attachments,  ///< on attachments
  aponeuroses   ///< on aponeuroses, which are the belly's broad sides where nothing is known of them
};
/// The names of the choices, in their order.
constexpr std::array<std::string_view, 3> choices_of(FiberEnds) { return {"automatic", "attachments", "aponeuroses"}; }

/// Of FiberSettings::smoothing_reach: fibers are as smooth as their rounds and the surface make them, through sections
/// of equal areas alone, and may turn back beside attachments.
inline constexpr Real unlimited_smoothing = 1;

/// The fibers of one muscle. Defaults, units and ranges: setting_table<FiberSettings>().
struct FiberSettings {
  int count = 100;    ///< fibers; 0: none
  int segments = 15;  ///< of each fiber
  FiberEnds ends = FiberEnds::automatic;
  FiberTemplate shape = FiberTemplate::parallel;
  Real pennation = 0.26;   ///< rad, angle of pennate fibers to the muscle's axis
  Real curvature = 0.2;    ///< largest deflection of the curved template, as a share of the muscle's width
  Real convergence = 0.5;  ///< how far the fan template draws together at the insertion, 0: not, 1: to a point
  int smoothing = 30;      ///< rounds of smoothing
  /// How far smoothing moves a fiber, as a share of half of its bundle's width and thickness, along each; or
  /// `unlimited_smoothing`, which draws all fibers of a thin tendon together where that bends.
  Real smoothing_reach = 0.25;
};

template <>
std::span<const Setting<FiberSettings>> setting_table();  ///< a row for each setting

}  // namespace gracilis
