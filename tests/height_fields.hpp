#pragma once

#include <gracilis/geometry/rbf_centers.hpp>
#include <gracilis/geometry/rbf_feature_centers.hpp>

#include <cmath>
#include <functional>

/// Heights over the unit square, shared by the tests and the study of radial basis functions.
namespace gracilis {

/// 41 × 41 nodes.
inline HeightField field_of(const std::function<Real(Real, Real)>& height) {
  HeightField field;
  field.columns = field.rows = 41;
  field.step = 1.0 / 40;
  field.heights.resize(41 * 41);
  for (Index j = 0; j < 41; ++j)
    for (Index i = 0; i < 41; ++i) field.heights[j * 41 + i] = height(i / 40.0, j / 40.0);
  return field;
}

/// The four Gaussians of Franke (1979), on which placements are usually compared.
inline Real franke(Real x, Real y) {
  const auto bump = [&](Real height, Real u, Real v) { return height * std::exp(-u - v); };
  const auto square = [](Real t) { return t * t; };
  return bump(0.75, square(9 * x - 2) / 4, square(9 * y - 2) / 4) +
         bump(0.75, square(9 * x + 1) / 49, (9 * y + 1) / 10) +
         bump(0.5, square(9 * x - 7) / 4, square(9 * y - 3) / 4) - bump(0.2, square(9 * x - 4), square(9 * y - 7));
}

}  // namespace gracilis
