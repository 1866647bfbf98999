#pragma once

#include <gracilis/view/pictures/picture_layout.hpp>

#include <vector>

namespace gracilis {

/// How far what a pixel shows is from the camera, m; infinite where it shows the background. The lowest row first.
struct DepthImage {
  int width = 0, height = 0;
  std::vector<float> depths;
};

/// Darkens pixels of a panel that lie in a valley, as where a muscle lies on another one or on a bone (ambient
/// occlusion from depths): the deeper a pixel is behind the middle of two opposite places around it, up to a fortieth
/// of the panel's height away, the darker it gets, by at most half. What slopes is not darkened, and neither is what
/// stands before something far away. `half_height`: m that the panel shows above its middle. Precondition: the image
/// has the part.
void add_soft_shadows(const DepthImage& depths, const Rectangle& part, Real half_height, PixelImage& image);

}  // namespace gracilis
