#pragma once

#include <gracilis/scene/setting_table.hpp>

/// Rows that settings tables of several methods share, for settings with members of these names.
namespace gracilis {

/// How far free vertices keep from bones (anatomy/overlap/bone_projection.hpp), m.
template <class Settings>
Setting<Settings> bone_margin_row() {
  return {"bone_margin", &Settings::bone_margin, "m", 0, 0.1, "Distance that free vertices keep from bones."};
}

/// Whether vertices nearer than that at rest keep their distance instead.
template <class Settings>
Setting<Settings> bone_rest_gap_row() {
  return {"bone_rest_gap",
          &Settings::bone_rest_gap,
          "",
          0,
          0,
          "Where a vertex is nearer to a bone than the margin at rest, or in it, keep that distance instead."};
}

/// Of what a blend of the bodies' motions carries (anatomy/attachments/skinning_weights.hpp), m.
template <class Settings>
Setting<Settings> tendon_length_row() {
  return {"tendon_length",
          &Settings::tendon_length,
          "m",
          0,
          1,
          "Distance from the attachments over which the blend of the bodies' motions is graded from tendon to belly; 0 "
          "grades nothing."};
}

}  // namespace gracilis
