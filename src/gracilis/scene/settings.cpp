#include <gracilis/scene/settings.hpp>

namespace gracilis {

template <>
std::span<const Setting<DistanceFieldSettings>> setting_table() {
  using S = DistanceFieldSettings;
  static const Setting<S> table[] = {
      {"cell_size", &S::cell_size, "m", 1e-5, 1, "Edge of the grid's cells; used where resolution is 0."},
      {"resolution", &S::resolution, "", 0, 1024, "Cells along each axis; 0 takes cell_size instead."},
      {"domain_margin", &S::domain_margin, "m", 0, 1, "Width of the grid around the bone's bounding box."},
      {"domain_factor", &S::domain_factor, "", 1, 10, "The bounding box is scaled by this about its center first."},
  };
  return table;
}

template <>
std::span<const Setting<SurfaceSettings>> setting_table() {
  using S = SurfaceSettings;
  static const Setting<S> table[] = {
      {"divide_needles", &S::divide_needles, "", 0, 1,
       "Where more than 1 % of a muscle's edges are longer than three times those of equal triangles, its triangles "
       "are "
       "made better: edges are flipped, and long ones halved. New vertices come after the file's own."},
  };
  return table;
}

template <>
std::span<const Setting<PrepareSettings>> setting_table() {
  using S = PrepareSettings;
  static const Setting<S> table[] = {
      {"edge_length", &S::edge_length, "m", 0, 0.1, "Edge length of the new triangles; 0 keeps the triangles."},
      {"remeshing_rounds", &S::remeshing_rounds, "", 1, 100,
       "Rounds of splitting, collapsing, flipping and smoothing edges."},
      {"smoothing_rounds", &S::smoothing_rounds, "", 0, 1000, "Rounds of smoothing the whole surface first."},
      {"rounding_rounds", &S::rounding_rounds, "", 0, 1000,
       "Rounds of smoothing spikes and rims at which the surface turns by more than 80 degrees."},
      {"muscle_gap", &S::muscle_gap, "m", 0, 0.01, "Gap that is made between two muscles where they are closer."},
      {"bone_gap", &S::bone_gap, "m", 0, 0.01, "Gap that is made between a muscle and a bone where they are closer."},
      {"keep_overlaps", &S::keep_overlaps, "", 0, 1,
       "Leaves muscles in each other and in bones where they are; neither gap is made then."},
      {"volume_tolerance", &S::volume_tolerance, "", 0, 1,
       "Share of its volume by which remeshing and rounding may change a muscle; more is taken back. 1 takes none "
       "back."},
      {"time_limit", &S::time_limit, "s", 0, 1e6, "Longest time for each surface, estimated before; 0 is without end."},
  };
  return table;
}

}  // namespace gracilis
