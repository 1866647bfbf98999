#include <gracilis/scene/fiber_settings.hpp>

namespace gracilis {

template <>
std::span<const Setting<FiberSettings>> setting_table() {
  using S = FiberSettings;
  static const Setting<S> table[] = {
      {"count", &S::count, "", 0, 100000, "Fibers inside the muscle; 0 makes none."},
      {"segments", &S::segments, "", 1, 10000, "Pieces of each fiber."},
      {"ends", &S::ends, "", 0, 0,
       "Where fibers end: at attachments, at aponeuroses, or at these where they are known or attachments are spread "
       "along the belly as they are."},
      {"shape", &S::shape, "", 0, 0,
       "How fibers run from origin to insertion: side by side, at an angle, in arcs, or drawn together at the "
       "insertion."},
      {"pennation", &S::pennation, "rad", -1.2, 1.2, "Angle of pennate fibers to the muscle's axis."},
      {"curvature", &S::curvature, "", -0.5, 0.5,
       "Largest deflection of curved fibers, as a share of the muscle's width."},
      {"convergence", &S::convergence, "", 0, 1,
       "How far a fan draws together at the insertion: 0 not at all, 1 to a point."},
      {"smoothing", &S::smoothing, "", 0, 10000, "Rounds of smoothing; the fibers' ends stay in place."},
      {"smoothing_reach", &S::smoothing_reach, "", 0, unlimited_smoothing,
       "How far smoothing moves a fiber at most, as a share of half of its bundle's width and thickness; 1: any way."},
  };
  return table;
}

}  // namespace gracilis
