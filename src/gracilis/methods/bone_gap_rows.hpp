#pragma once

#include <gracilis/scene/setting_table.hpp>

/// Rows of settings tables that say how far free vertices keep from bones (anatomy/overlap/bone_projection.hpp), for settings
/// with the members `bone_margin` (m) and `bone_rest_gap`.
namespace gracilis {

template <class Settings>
Setting<Settings> bone_margin_row() {
  return {"bone_margin", &Settings::bone_margin, "m", 0, 0.1, "Distance that free vertices keep from bones."};
}

template <class Settings>
Setting<Settings> bone_rest_gap_row() {
  return {"bone_rest_gap",
          &Settings::bone_rest_gap,
          "",
          0,
          0,
          "Where a vertex is nearer to a bone than the margin at rest, or in it, keep that distance instead."};
}

}  // namespace gracilis
