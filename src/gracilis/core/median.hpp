#pragma once

#include <gracilis/core/types.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace gracilis {

/// The middle one of the values in order, the mean of two middle ones; 0 where there are none.
inline Real median(std::vector<Real> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return values.size() % 2 == 1 ? *middle : (*std::max_element(values.begin(), middle) + *middle) / 2;
}

}  // namespace gracilis
