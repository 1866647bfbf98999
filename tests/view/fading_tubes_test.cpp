#include <gracilis/view/pictures/picture.hpp>

#include <gtest/gtest.h>

#include <algorithm>

namespace gracilis {

TEST(Picture, tubes_that_fade_are_paler_further_back) {
  // Two of one color, one above the other in the picture; the lower one is 0.4 m further from the camera.
  PaintedLines tubes{{}, Color(0.7, 0.2, 0.2)};
  tubes.radius = 0.1;
  tubes.fades = true;
  for (const Real z : {0.5, -0.5}) {
    Points line(3, 3);
    line << -1, 0, 1, 0.2 - 0.4 * (z > 0), 0.2 - 0.4 * (z > 0), 0.2 - 0.4 * (z > 0), z, z, z;
    tubes.lines.append(line);
  }
  Picture picture;
  picture.panel_width = picture.panel_height = 200;
  picture.background = Color::Zero();
  picture.panels.push_back({"", {}, {tubes}});
  const PixelImage image = PictureDrawer().draw(picture);
  int green[2] = {0, 0};  // the brightest of the upper and the lower half
  for (int y = 0; y < image.height; ++y) {
    const auto middle = static_cast<std::size_t>(y * image.width + image.width / 2);
    int& brightest = green[2 * y / image.height];
    brightest = std::max(brightest, static_cast<int>(image.rgba[4 * middle + 1]));
  }
  EXPECT_LT(green[0], 80);
  EXPECT_GT(green[1], green[0] + 60);
}

}  // namespace gracilis
