#pragma once

#include <gracilis/core/types.hpp>

#include <vector>

namespace gracilis {

/// A curve of cubic pieces between knots, straight beyond them; constant where there is one knot, zero where there is
/// none. A knot that stands twice is a bend: the first slope holds before it, the second behind.
struct HermiteCurve {
  std::vector<Real> knots, values, slopes;  ///< as many of each; knots do not fall
};

Real value_at(const HermiteCurve& curve, Real x);  ///< straight beyond the knots

}  // namespace gracilis
