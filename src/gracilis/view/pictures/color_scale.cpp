#include <gracilis/view/pictures/color_scale.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

static std::vector<Color> bytes(const std::vector<Vec3>& colors) {
  std::vector<Color> result;
  for (const Vec3& color : colors) result.push_back(color / 255);
  return result;
}

const std::vector<ColorScale>& color_scales() {
  static const std::vector<Color> diverging =
      bytes({{33, 102, 172}, {146, 197, 222}, {247, 244, 238}, {244, 165, 130}, {178, 24, 43}});
  static const std::vector<Color> rising = bytes({{250, 240, 225}, {240, 170, 120}, {205, 70, 60}, {110, 10, 60}});
  static const std::vector<Color> falling(rising.rbegin(), rising.rend());
  // Thin lines on pale muscles want a darker middle.
  static const std::vector<Color> lines =
      bytes({{20, 70, 150}, {75, 125, 175}, {150, 150, 150}, {195, 98, 72}, {165, 20, 40}});
  static const std::vector<Color> lines_rising = bytes({{125, 170, 205}, {190, 115, 105}, {180, 50, 52}, {90, 5, 52}});
  static const Real fiber_end = std::log2(1.5);
  static const std::vector<ColorScale> scales = {
      {"natural", "", {}, 0, 1, {}},
      {"muscle", "", {}, 0, 1, {}},
      {"activation", "activation", rising, 0, 1, {"0", "0.5", "1"}},
      {"fiber-strain", "fiber length, × rest", lines, -fiber_end, fiber_end, {"0.67", "1", "1.5"}},
      {"edge-stretch", "edge length, × rest", diverging, -1, 1, {"0.5", "1", "2"}},
      {"bone-gap", "distance to bone, mm", falling, 0, 0.01, {"0", "5", "≥ 10"}},
      {"volume", "change of volume, %", diverging, -0.01, 0.01, {"-1", "0", "+1"}},
      {"stress", "stress of fibers, kPa", rising, 4, 6, {"10", "100", "1000"}},
      {"tension", "tension of fibers, N", lines_rising, -2, 1, {"0.01", "0.1", "1", "10"}}};
  return scales;
}

const ColorScale& color_scale(ColorBy by) { return color_scales()[static_cast<std::size_t>(by)]; }

std::vector<std::string> ticks_for(const ColorScale& scale, std::pair<Real, Real> seen) {
  constexpr Real rounding = 1e-9;
  std::vector<std::string> ticks = scale.ticks;
  if (ticks.empty()) return ticks;
  const auto says_so = [](const std::string& tick) { return tick.starts_with("≤") || tick.starts_with("≥"); };
  if (seen.first < scale.low - rounding && !says_so(ticks.front())) ticks.front() = "≤ " + ticks.front();
  if (seen.second > scale.high + rounding && !says_so(ticks.back())) ticks.back() = "≥ " + ticks.back();
  return ticks;
}

Color color_at(const ColorScale& scale, Real value) {
  if (!std::isfinite(value)) return Color::Constant(0.6);
  const auto last = static_cast<Real>(scale.colors.size() - 1);
  const Real at = std::clamp((value - scale.low) / (scale.high - scale.low), 0.0, 1.0) * last;
  const auto below = static_cast<std::size_t>(std::min(std::floor(at), last - 1));
  return scale.colors[below] + (at - static_cast<Real>(below)) * (scale.colors[below + 1] - scale.colors[below]);
}

}  // namespace gracilis
