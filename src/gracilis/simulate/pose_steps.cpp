#include <gracilis/simulate/pose_steps.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/stop.hpp>
#include <gracilis/geometry/screw.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace gracilis {

// 100 m of 5 mm each, and half a gigabyte: beyond them a motion is a mistake, and its steps would take days.
static constexpr Real most_steps = 20'000, most_places = 4e6;

/// How many steps the way of one body against another takes; not rounded, and not finite where the way is not.
static Real steps_wanted(const Screw& screw, Real largest_turn, Real largest_slide) {
  const Real turns = screw.angle / largest_turn, slides = std::abs(screw.slide) / largest_slide;
  return turns > slides || std::isnan(turns) ? turns : slides;
}

static int step_count(const std::vector<RigidTransform>& from, const std::vector<RigidTransform>& to, Real largest_turn,
                      Real largest_slide) {
  const Real most =
      std::min(most_steps, std::floor(most_places / static_cast<Real>(std::max<std::size_t>(from.size(), 1))));
  Real wanted = 1;
  for (std::size_t a = 0; a < from.size(); ++a) {
    throw_if_stopped();
    for (std::size_t b = 0; b < a; ++b) {
      const RigidTransform before = from[b].inverse() * from[a], now = to[b].inverse() * to[a];
      const Real here = steps_wanted(screw_of(now * before.inverse()), largest_turn, largest_slide);
      if (!(here <= most))
        throw QualityError("between two poses the scene's body number " + std::to_string(a) +
                           " moves too far against body number " + std::to_string(b) +
                           ", by more than there are steps to follow it: correct the coordinates that jump there");
      wanted = std::max(wanted, here);
    }
  }
  return static_cast<int>(std::ceil(wanted - 1e-6));
}

std::vector<std::vector<RigidTransform>> pose_steps(const std::vector<RigidTransform>& from,
                                                    const std::vector<RigidTransform>& to, Real largest_turn,
                                                    Real largest_slide) {
  const int count = step_count(from, to, largest_turn, largest_slide);
  std::vector<std::vector<RigidTransform>> steps(static_cast<std::size_t>(count), from);
  for (std::size_t body = 0; body < from.size(); ++body) {
    throw_if_stopped();
    const RigidTransform motion = to[body] * from[body].inverse();
    for (int i = 0; i + 1 < count; ++i)
      steps[static_cast<std::size_t>(i)][body] = share_of_screw(motion, static_cast<Real>(i + 1) / count) * from[body];
  }
  steps.back() = to;
  return steps;
}

}  // namespace gracilis
