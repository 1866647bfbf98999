#include <gracilis/view/pictures/soft_shadows.hpp>

#include <gracilis/core/parallel.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace gracilis {

namespace {

struct PixelStep {
  int x = 0, y = 0;
};

/// Half of the places around a pixel, on three circles; the others lie opposite.
std::vector<PixelStep> steps_around(Real reach) {
  std::vector<PixelStep> steps;
  for (const auto& [share, count] : {std::pair{0.25, 4}, {0.55, 6}, {1.0, 8}})
    for (int i = 0; i < count; ++i) {
      const Real angle = pi * (i + share) / count;
      const PixelStep step{static_cast<int>(std::lround(share * reach * std::cos(angle))),
                           static_cast<int>(std::lround(share * reach * std::sin(angle)))};
      if (step.x != 0 || step.y != 0) steps.push_back(step);
    }
  return steps;
}

/// 0 where nothing is before the pixel, towards 1 at the bottom of a narrow valley.
Real occlusion_at(const DepthImage& image, int x, int y, const std::vector<PixelStep>& steps, float reach) {
  const auto depth = [&](int column, int row) {
    column = std::clamp(column, 0, image.width - 1), row = std::clamp(row, 0, image.height - 1);
    return image.depths[static_cast<std::size_t>(row * image.width + column)];
  };
  const float here = depth(x, y);
  float sum = 0;
  for (const PixelStep step : steps) {
    // How far each place is before this one; what lies far before it is something else and hides less.
    const auto before = [&](float there) {
      const float lead = here - there;
      return lead > 3 * reach ? reach * std::max(0.0f, 2 - lead / (3 * reach)) : std::clamp(lead, -reach, reach);
    };
    sum += std::max(0.0f, before(depth(x + step.x, y + step.y)) + before(depth(x - step.x, y - step.y)));
  }
  return sum / (2 * reach * static_cast<float>(steps.size()));
}

}  // namespace

void add_soft_shadows(const DepthImage& depths, const Rectangle& part, Real half_height, PixelImage& image) {
  constexpr Real strength = 2, darkest = 0.5;
  const Real pixels = std::max(4.0, depths.height / 40.0);
  const auto reach = static_cast<float>(pixels * 2 * half_height / depths.height);
  const std::vector<PixelStep> steps = steps_around(pixels);
  parallel_for(depths.height, 16, [&](Index begin, Index end) {
    for (int y = static_cast<int>(begin); y < end; ++y)
      for (int x = 0; x < depths.width; ++x) {
        if (!std::isfinite(depths.depths[static_cast<std::size_t>(y * depths.width + x)])) continue;
        const Real light = 1 - std::min(darkest, strength * occlusion_at(depths, x, y, steps, reach));
        const int row = image.height - 1 - (part.y + y);
        unsigned char* pixel =
            image.rgba.data() + 4 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                                     static_cast<std::size_t>(part.x + x));
        for (int k = 0; k < 3; ++k) pixel[k] = static_cast<unsigned char>(std::lround(light * pixel[k]));
      }
  });
}

}  // namespace gracilis
