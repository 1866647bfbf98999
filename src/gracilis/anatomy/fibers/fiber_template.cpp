#include <gracilis/anatomy/fibers/fiber_template.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

using Vec2 = Eigen::Vector2d;

std::vector<Vec2> spread_over_square(Index count) {
  // 1/φ₂ and 1/φ₂², φ₂ = 1.3247... the root of x³ = x + 1 (Roberts 2018).
  constexpr Real first = 0.7548776662466927, second = 0.5698402909980532;
  const auto fraction = [](Real x) { return x - std::floor(x); };
  std::vector<Vec2> points;
  for (Index i = 0; i < count; ++i) points.emplace_back(fraction(0.5 + first * i), fraction(0.5 + second * i));
  return points;
}

Vec2 template_point(const FiberSettings& settings, const Vec2& start, Real s, Real slenderness) {
  constexpr Real margin = 0.01;  // along the very side several fibers would become one
  Vec2 point = start;
  switch (settings.shape) {
    case FiberTemplate::parallel:
      break;
    case FiberTemplate::pennate:
      point.x() += std::tan(settings.pennation) * slenderness * (s - 0.5);
      break;
    case FiberTemplate::curved:
      point.x() += settings.curvature * std::sin(pi * s);
      break;
    case FiberTemplate::fan:
      point = Vec2(0.5, 0.5) + (start - Vec2(0.5, 0.5)) * (1 - settings.convergence * s);
      break;
  }
  return point.cwiseMax(margin).cwiseMin(1 - margin);
}

}  // namespace gracilis
