#pragma once

#include <gracilis/methods/method_entry.hpp>
#include <gracilis/scene/setting_values.hpp>

#include <memory>
#include <vector>

namespace gracilis {

/// Which curvature the centers keep.
enum class RbfReference {
  carried,  ///< that of the capture pose, carried along with the bodies
  space     ///< that which the capture pose has in the same place of space, as published (Cervenka 2024, eq. 6.6)
};
/// The names of the choices, in their order.
constexpr std::array<std::string_view, 2> choices_of(RbfReference) { return {"carried", "space"}; }

/// What the functions' weights do when their centers move.
enum class RbfWeights {
  refitted,  ///< so that points that moved along keep their values
  kept       ///< nothing, as published
};
/// The names of the choices, in their order.
constexpr std::array<std::string_view, 2> choices_of(RbfWeights) { return {"refitted", "kept"}; }

/// How a muscle keeps its volume.
enum class RbfVolume {
  none,
  offset  ///< one number by which the surface's level is moved
};
/// The names of the choices, in their order.
constexpr std::array<std::string_view, 2> choices_of(RbfVolume) { return {"none", "offset"}; }

/// Of one muscle.
struct RbfSettings {
  int centers = 300;
  Real reach = 1.2;  ///< of the Gaussians, in mean distances of centers
  RbfWeights weights = RbfWeights::refitted;
  int descent_steps = 5;
  RbfReference reference = RbfReference::carried;
  RbfVolume volume = RbfVolume::offset;
  bool bones = true;          ///< keep out of them
  Real tendon_length = 0.03;  ///< m from attachments, graded from tendon to belly; 0: no tendons
  Real bone_margin = 0.0005;  ///< m
  bool bone_rest_gap = true;  ///< where there is less at rest, keep that
};

template <>
std::span<const Setting<RbfSettings>> setting_table();  ///< a row for each setting

/// The method `rbf`, with the preset `rbf-2024`.
MethodEntry rbf_entry();

/// Muscles as implicit surfaces of radial basis functions (Cervenka 2024, chapter 6). A blend of the bodies' motions
/// carries the centers, attached ones with their bone; the others are moved so that the field's curvature stays, and,
/// switchable, out of bones on the way from the capture pose. Vertices follow the centers to their level of the field,
/// which one offset moves until the volume is right, and out of bones. A shape follows from the pose alone. Muscles do
/// not see each other, and those attached to nothing stay. Precondition: the scene is valid.
std::unique_ptr<DeformationMethod> make_rbf_method(const Scene& scene, std::vector<DistanceField> fields);

}  // namespace gracilis
