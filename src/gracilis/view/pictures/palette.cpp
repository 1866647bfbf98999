#include <gracilis/view/pictures/palette.hpp>

#include <array>

namespace gracilis {

static Color rgb(int hex) { return Color((hex >> 16) & 0xff, (hex >> 8) & 0xff, hex & 0xff) / 255; }

Color bone_color() { return rgb(0xf4ead2); }

Color muscle_color(Index i, Palette palette) {
  // Dark and light alternate: lightness is what survives gray print and every kind of color blindness.
  static constexpr std::array flesh = {0xa8322d, 0xe8967f, 0x6b2346, 0xd07a2e, 0xc2587e, 0x7d4a2b, 0xf0b89a, 0x8f5aa0};
  static constexpr std::array okabe_ito = {0xd55e00, 0x56b4e9, 0x009e73, 0xe69f00,
                                           0x0072b2, 0xcc79a7, 0xf0e442, 0x555555};
  const std::array<int, 8>& colors = palette == Palette::flesh ? flesh : okabe_ito;
  return rgb(colors[static_cast<std::size_t>(i) % colors.size()]);
}

}  // namespace gracilis
