#pragma once

#include <gracilis/anatomy/sections/enhancement.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/opensim/import/neighbor_clearance.hpp>

#include <map>
#include <memory>
#include <optional>
#include <string>

namespace gracilis::opensim {

/// What of a muscle's line is tendon: what its belly leaves, or parts of the tendon's slack length (Laclé 2014, section
/// 3.4.3).
enum class TendonPlace {
  beyond_belly,       ///< at the insertion, as much as a belly of belly_on_line leaves
  half_at_insertion,  ///< half of its slack length, as Laclé has it
  whole_at_insertion,
  both_ends  ///< half of it at each
};

/// How muscles that are lines become volumes.
struct VolumeSettings {
  int rays = 12;                  ///< corners of a section, even
  Real section_distance = 0.008;  ///< m, at most this far apart; of sheets 1.5 times
  std::optional<int> scaling;     ///< instead: how often each part of the line is halved (Laclé's LSS), 0 to 16
  Real specific_tension = 6.1e5;  ///< N/m²
  TendonPlace tendon = TendonPlace::beyond_belly;
  bool tendon_sections = false;  ///< a section more where each tendon ends, between its neighbors in shape
  /// Surfaces that are known, by the muscles' names, closed, in the ground frame: sections are brought onto them.
  std::map<std::string, TriangleMesh> surfaces;
  std::shared_ptr<const std::vector<SolidBone>> bones;  ///< that the others keep out of; none: they do not
  std::map<std::string, RoundMuscle>
      beside;  ///< muscles by name that the others keep out of, too, where there are bones; sections of a muscle among
               ///< them have these centers before they are brought out of the bones
  EnhancementSettings enhancement = {.more_rays = 6};
};

}  // namespace gracilis::opensim
