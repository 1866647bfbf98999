#pragma once

#include <gracilis/scene/setting_table.hpp>

namespace gracilis {

/// Settings of the distance fields of all bones.
struct DistanceFieldSettings {
  Real cell_size = 0.001;      ///< m; used where resolution is 0
  int resolution = 0;          ///< cells along each axis, as published; 0: from cell_size
  Real domain_margin = 0.012;  ///< m around the bone's bounding box
  Real domain_factor = 1;      ///< bounding box scaled by this factor about its center, as published
};

/// What is done to muscles' surfaces when they are read.
struct SurfaceSettings {
  bool divide_needles = true;  ///< where a surface is made of them (geometry/needles.hpp)
};

/// Settings of the optional preparation of a scene's muscles before anything else is done with them.
struct PrepareSettings {
  Real edge_length = 0.003;       ///< m, of the new triangles; 0 keeps the triangles
  int remeshing_rounds = 10;      ///< of splitting, collapsing, flipping and smoothing
  int smoothing_rounds = 0;       ///< of the whole surface, before it is remeshed
  int rounding_rounds = 20;       ///< of sharp rims and spikes
  Real muscle_gap = 0.0003;       ///< m, kept between two muscles
  Real bone_gap = 0.0003;         ///< m, kept between a muscle and a bone
  bool keep_overlaps = false;     ///< muscles stay where they are, in each other and in bones
  Real volume_tolerance = 0.005;  ///< share by which remeshing and rounding may change a volume; 1: as it comes
  Real time_limit = 40;           ///< s for each surface; 0: none
};

template <>
std::span<const Setting<DistanceFieldSettings>> setting_table();  ///< a row for each setting
template <>
std::span<const Setting<SurfaceSettings>> setting_table();  ///< a row for each setting
template <>
std::span<const Setting<PrepareSettings>> setting_table();  ///< a row for each setting

}  // namespace gracilis
