#pragma once

#include <gracilis/core/types.hpp>

#include <array>
#include <string_view>

namespace gracilis {

/// How a radial basis function falls with distance (Cervenka 2024, tables 3.1 and 3.2). The first ten end at the reach;
/// `wendland_dk` is positive definite in up to d dimensions and, for k > 0, 2k times continuously differentiable
/// (Wendland 1995).
enum class RadialShape {
  wendland_10,    ///< table 3.1, number 1
  wendland_11,    ///< 2
  wendland_12,    ///< 3
  wendland_30,    ///< 4
  wendland_31,    ///< 5
  wendland_32,    ///< 6
  wendland_33,    ///< 7
  wendland_50,    ///< 8
  wendland_51,    ///< 9
  wendland_52,    ///< 10
  gaussian,       ///< exp(-s²)
  thin_plate,     ///< s² log s
  power_minus_1,  ///< s² (s^a - 1)
};
/// The names of the choices, in their order.
constexpr std::array<std::string_view, 13> choices_of(RadialShape) {
  return {"wendland-10", "wendland-11", "wendland-12", "wendland-30", "wendland-31", "wendland-32",  "wendland-33",
          "wendland-50", "wendland-51", "wendland-52", "gaussian",    "thin-plate",  "power-minus-1"};
}

/// A function φ(s) of s = r / reach, r the distance from a center. The shape parameter α of the Gaussian exp(-α r²) is
/// 1 / reach².
struct RadialKernel {
  RadialShape shape = RadialShape::gaussian;
  Real exponent = 1.5;  ///< a of `power_minus_1`, above 0; whole numbers make systems of equations ill-conditioned
};

/// A kernel and its derivatives by r at one distance.
struct RadialProfile {
  Real value = 0;
  Real slope = 0;         ///< φ'
  Real slope_over_r = 0;  ///< φ' / r, with its limit at r = 0
  Real second = 0;        ///< φ''
  Real third = 0;         ///< φ'''
};

/// Closed forms, at r = 0 their limits from above: infinite where there is none (φ'/r of functions with a kink at the
/// center; φ'' of the thin plate). Preconditions: r >= 0, reach > 0.
RadialProfile radial_profile(const RadialKernel& kernel, Real reach, Real r);

/// φ alone.
Real radial_value(const RadialKernel& kernel, Real reach, Real r);

/// Whether it ends at the reach.
constexpr bool is_compact(const RadialKernel& kernel) { return kernel.shape < RadialShape::gaussian; }

}  // namespace gracilis
