#pragma once

#include <gracilis/geometry/radial_kernel.hpp>

#include <vector>

namespace gracilis {

/// One kernel of every shape.
inline std::vector<RadialKernel> all_kernels() {
  constexpr int shape_count = 13;
  std::vector<RadialKernel> kernels;
  for (int i = 0; i < shape_count; ++i) kernels.push_back({static_cast<RadialShape>(i), 1.7});
  return kernels;
}

}  // namespace gracilis
