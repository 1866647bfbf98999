#include <gracilis/simulate/pose_steps.hpp>

#include <gracilis/geometry/screw.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

std::vector<std::vector<RigidTransform>> pose_steps(const std::vector<RigidTransform>& from,
                                                    const std::vector<RigidTransform>& to, Real largest_turn,
                                                    Real largest_slide) {
  Real wanted = 1;
  for (std::size_t a = 0; a < from.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const RigidTransform before = from[b].inverse() * from[a], now = to[b].inverse() * to[a];
      const Screw screw = screw_of(now * before.inverse());
      wanted = std::max({wanted, screw.angle / largest_turn, std::abs(screw.slide) / largest_slide});
    }
  const int count = static_cast<int>(std::ceil(wanted - 1e-6));
  std::vector<std::vector<RigidTransform>> steps(static_cast<std::size_t>(count), from);
  for (std::size_t body = 0; body < from.size(); ++body) {
    const RigidTransform motion = to[body] * from[body].inverse();
    for (int i = 0; i + 1 < count; ++i)
      steps[static_cast<std::size_t>(i)][body] = share_of_screw(motion, static_cast<Real>(i + 1) / count) * from[body];
  }
  steps.back() = to;
  return steps;
}

}  // namespace gracilis
