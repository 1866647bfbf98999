#pragma once

#include <gracilis/methods/method_entry.hpp>
#include <gracilis/scene/setting_values.hpp>

#include <memory>
#include <vector>

namespace gracilis {

/// How a muscle comes back to its volume; the energy knows none.
enum class ArapVolume {
  none,
  scaling,    ///< free vertices about the muscle's center, (Cervenka 2024, eq. 4.2)
  multiplier  ///< what pushes evenly on the surface, passed on through it
};
/// The names of the choices, in their order.
constexpr std::array<std::string_view, 3> choices_of(ArapVolume) { return {"none", "scaling", "multiplier"}; }

/// Of one muscle.
struct ArapSettings {
  int iterations = 8;  ///< of local and global step, volume and contact, per frame
  ArapVolume volume = ArapVolume::multiplier;
  Real tendon_length = 0.03;  ///< m from attachments, graded from tendon to belly; 0: no tendons
  Real bone_margin = 0.0005;  ///< m
  bool bone_rest_gap = true;  ///< where there is less at rest, keep that
};

template <>
std::span<const Setting<ArapSettings>> setting_table();  ///< a row for each setting

/// The method `arap`.
MethodEntry arap_entry();

/// As-rigid-as-possible surfaces (Sorkine and Alexa 2007), held at their attachments: every frame begins where a blend
/// of the bodies' motions carries the last one, and between the steps of the iteration volumes are restored and
/// vertices brought out of bones. Muscles do not see each other, and those attached to nothing stay. Precondition: the
/// scene is valid.
std::unique_ptr<DeformationMethod> make_arap_method(const Scene& scene, std::vector<DistanceField> fields);

}  // namespace gracilis
