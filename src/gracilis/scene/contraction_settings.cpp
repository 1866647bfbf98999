#include <gracilis/scene/contraction_settings.hpp>

namespace gracilis {

template <>
std::span<const Setting<ContractionSettings>> setting_table() {
  using S = ContractionSettings;
  static const Setting<S> table[] = {
      {"threshold", &S::threshold, "", 0, 1,
       "Activation above which a muscle contracts; with 0 and without ramp it does always, at none, too."},
      {"shortest", &S::shortest, "", 0.1, 1,
       "A segment of a surface fiber aims at its length at rest times the larger of this and 1 - activation."},
      {"stiffness", &S::stiffness, "N/m", 0, 1e18,
       "Tension across each metre of the surface's width per relative excess length, however many fibers there are; "
       "full from the activation on at which segments aim at the shortest. Without spread and area_scaling: of a "
       "segment, per fiber that runs over it."},
      {"two_sided", &S::two_sided, "", 0, 0,
       "Contracting edges hold the length that they aim at both ways, as published; false: they only pull."},
      {"ramp", &S::ramp, "", 0, 0,
       "The stiffness rises with the activation, from none at 0; false: it is full wherever the muscle contracts, as "
       "published."},
      {"spread", &S::spread, "", 0, 0,
       "All edges that run along the fibers pull, by their direction; false: only the edges that fibers carried onto "
       "the surface pass through, as published."},
      {"paths", &S::paths, "", 0, 0,
       "How fibers are carried onto the surface, without spread: 'along_fibers' follows their direction, "
       "'nearest_joined' is "
       "the published way by nearest vertices."},
      {"area_scaling", &S::area_scaling, "", 0, 0,
       "Segments of surface fibers pull each for the area nearest to it, so that tension does not depend on how many "
       "fibers there are; false: each as often as fibers run over it, as published. Without spread only."},
      {"segments", &S::segments, "", 1, 10000, "Pieces of each fiber that is carried onto the surface."},
      {"reject_across", &S::reject_across, "", 0, 0,
       "Segments of surface fibers that run more than 60 degrees off the fibers inside are left out; false: none is, "
       "as published."},
  };
  return table;
}

}  // namespace gracilis
