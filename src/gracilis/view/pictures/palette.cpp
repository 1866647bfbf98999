#include <gracilis/view/pictures/palette.hpp>

#include <array>

namespace gracilis {

static Color rgb(int hex) { return Color((hex >> 16) & 0xff, (hex >> 8) & 0xff, hex & 0xff) / 255; }

Color bone_color() { return rgb(0xf4ead2); }

Color flesh_color() { return {0.88, 0.76, 0.72}; }

Color series_color(Index i) {
  // Okabe and Ito (2008), made for color-blind readers.
  static constexpr std::array colors = {0xd55e00, 0x56b4e9, 0x009e73, 0xe69f00, 0x0072b2, 0xcc79a7, 0xf0e442, 0x555555};
  return rgb(colors[static_cast<std::size_t>(i) % colors.size()]);
}

}  // namespace gracilis
