#include <gracilis/geometry/radial_kernel.hpp>

#include <cmath>
#include <limits>

namespace gracilis {

namespace {

constexpr Real infinity = std::numeric_limits<Real>::infinity();

/// (1 - s)^power times a polynomial in s.
struct CompactForm {
  int power;
  std::array<Real, 4> factors;
};

/// Number 9 has the power 5 as in Wendland 1995: with the 3 of the report's table it would grow away from its center.
constexpr std::array<CompactForm, 10> compact_forms = {{{1, {1}},
                                                        {3, {1, 3}},
                                                        {5, {1, 5, 8}},
                                                        {2, {1}},
                                                        {4, {1, 4}},
                                                        {6, {3, 18, 35}},
                                                        {8, {1, 8, 25, 32}},
                                                        {3, {1}},
                                                        {5, {1, 5}},
                                                        {7, {1, 7, 16}}}};

Real polynomial(const std::array<Real, 4>& c, Real s) { return c[0] + s * (c[1] + s * (c[2] + s * c[3])); }

/// u^n, and 0 where what stands before it is 0 and n negative.
Real power(Real u, int n) {
  Real result = 1;
  for (int i = 0; i < n; ++i) result *= u;
  return result;
}

RadialProfile compact(const CompactForm& form, Real s) {
  if (s >= 1) return {};
  const auto& c = form.factors;
  const std::array<Real, 4> first = {c[1], 2 * c[2], 3 * c[3], 0}, second = {2 * c[2], 6 * c[3], 0, 0},
                            third = {6 * c[3], 0, 0, 0};
  const Real n = form.power, u = 1 - s;
  const Real p = polynomial(c, s), p1 = polynomial(first, s), p2 = polynomial(second, s), p3 = polynomial(third, s);
  const Real un = power(u, form.power), un1 = power(u, form.power - 1), un2 = power(u, form.power - 2),
             un3 = power(u, form.power - 3);
  RadialProfile at;
  at.value = un * p;
  at.second = n * (n - 1) * un2 * p - 2 * n * un1 * p1 + un * p2;
  at.third = -n * (n - 1) * (n - 2) * un3 * p + 3 * n * (n - 1) * un2 * p1 - 3 * n * un1 * p2 + un * p3;
  // φ' = (1 - s)^(n - 1) q(s), q = (1 - s) p' - n p; where q(0) = 0 its division by s is exact.
  std::array<Real, 4> q{};
  for (std::size_t k = 0; k < 4; ++k) q[k] = first[k] - (k > 0 ? first[k - 1] : 0) - n * c[k];
  at.slope = un1 * polynomial(q, s);
  if (q[0] == 0)
    at.slope_over_r = un1 * polynomial({q[1], q[2], q[3], 0}, s);
  else
    at.slope_over_r = s > 0 ? at.slope / s : -infinity;
  return at;
}

RadialProfile gaussian(Real s) {
  const Real e = std::exp(-s * s);
  return {e, -2 * s * e, -2 * e, (4 * s * s - 2) * e, (12 * s - 8 * s * s * s) * e};
}

RadialProfile thin_plate(Real s) {
  if (s == 0) return {0, 0, -infinity, -infinity, infinity};
  const Real log = std::log(s);
  return {s * s * log, s * (2 * log + 1), 2 * log + 1, 2 * log + 3, 2 / s};
}

RadialProfile power_minus_1(Real a, Real s) {
  const Real to_a = std::pow(s, a);
  const Real third = (a + 2) * (a + 1) * a * std::pow(s, a - 1);
  return {s * s * (to_a - 1), s * ((a + 2) * to_a - 2), (a + 2) * to_a - 2, (a + 2) * (a + 1) * to_a - 2, third};
}

RadialProfile scaled_profile(const RadialKernel& kernel, Real s) {
  switch (kernel.shape) {
    case RadialShape::gaussian:
      return gaussian(s);
    case RadialShape::thin_plate:
      return thin_plate(s);
    case RadialShape::power_minus_1:
      return power_minus_1(kernel.exponent, s);
    default:
      return compact(compact_forms[static_cast<std::size_t>(kernel.shape)], s);
  }
}

}  // namespace

RadialProfile radial_profile(const RadialKernel& kernel, Real reach, Real r) {
  RadialProfile at = scaled_profile(kernel, r / reach);
  at.slope /= reach;
  at.slope_over_r /= reach * reach;
  at.second /= reach * reach;
  at.third /= reach * reach * reach;
  return at;
}

Real radial_value(const RadialKernel& kernel, Real reach, Real r) {
  const Real s = r / reach;
  switch (kernel.shape) {
    case RadialShape::gaussian:
      return std::exp(-s * s);
    case RadialShape::thin_plate:
      return s > 0 ? s * s * std::log(s) : 0;
    case RadialShape::power_minus_1:
      return s * s * (std::pow(s, kernel.exponent) - 1);
    default:
      break;
  }
  if (s >= 1) return 0;
  const CompactForm& form = compact_forms[static_cast<std::size_t>(kernel.shape)];
  return power(1 - s, form.power) * polynomial(form.factors, s);
}

}  // namespace gracilis
