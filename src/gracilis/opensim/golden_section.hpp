#pragma once

#include <gracilis/core/types.hpp>

#include <cmath>

namespace gracilis::opensim {

/// Where in [low, high] a function with one dip is least, to 1e-10 of the interval (golden section; Kiefer 1953).
template <class F>
Real least_between(Real low, Real high, const F& function) {
  const Real ratio = (std::sqrt(5.0) - 1) / 2;
  Real left = high - ratio * (high - low), right = low + ratio * (high - low);
  Real at_left = function(left), at_right = function(right);
  for (int i = 0; i < 48; ++i) {
    if (at_left < at_right) {
      high = right;
      right = left;
      at_right = at_left;
      at_left = function(left = high - ratio * (high - low));
    } else {
      low = left;
      left = right;
      at_left = at_right;
      at_right = function(right = low + ratio * (high - low));
    }
  }
  return (low + high) / 2;
}

}  // namespace gracilis::opensim
