#include <gracilis/scene/contraction_settings.hpp>

namespace gracilis {

template <>
std::span<const Setting<ContractionSettings>> setting_table() {
  using S = ContractionSettings;
  static const Setting<S> table[] = {
      {"threshold", &S::threshold, "", 0, 1, "Activation above which a muscle contracts."},
      {"shortest", &S::shortest, "", 0.1, 1,
       "A segment of a surface fiber aims at its length at rest times the larger of this and 1 - activation."},
      {"stiffness", &S::stiffness, "N/m", 0, 1e18,
       "Tension across each metre of the surface's width per relative excess length, however many fibers there are; "
       "full from the activation on at which segments aim at the shortest."},
      {"spread", &S::spread, "", 0, 0,
       "All edges that run along the fibers pull, by their direction; false: only the edges that fibers carried onto "
       "the surface pass through, as published."},
      {"paths", &S::paths, "", 0, 0,
       "How fibers are carried onto the surface, without spread: 'along_fibers' follows their direction, "
       "'nearest_joined' is "
       "the published way by nearest vertices."},
      {"segments", &S::segments, "", 1, 10000, "Pieces of each fiber that is carried onto the surface."},
  };
  return table;
}

}  // namespace gracilis
