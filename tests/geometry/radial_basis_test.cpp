#include <gracilis/geometry/radial_basis.hpp>

#include "radial_kernels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace gracilis {
namespace {

constexpr Real reach = 0.8;

/// Of those that end, only these are twice differentiable at their center; the others' Hessians are off by a kink.
bool has_kink(RadialShape shape) {
  return shape == RadialShape::wendland_10 || shape == RadialShape::wendland_30 || shape == RadialShape::wendland_50;
}

std::string name_of(const RadialKernel& kernel) {
  return std::string(choices_of(RadialShape{})[static_cast<std::size_t>(kernel.shape)]);
}

RadialBasis some_basis(const RadialKernel& kernel, int dimensions) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<Real> uniform(-0.5, 0.5);
  RadialBasis basis;
  basis.kernel = kernel;
  basis.dimensions = dimensions;
  constexpr Index count = 12;
  basis.centers = Points::Zero(3, count);
  basis.weights.resize(count);
  basis.reaches.resize(count);
  for (Index i = 0; i < count; ++i) {
    for (int k = 0; k < dimensions; ++k) basis.centers(k, i) = uniform(generator);
    basis.weights[i] = uniform(generator);
    basis.reaches[i] = 0.8 + 0.4 * uniform(generator);
  }
  basis.polynomial = Eigen::VectorXd::LinSpaced(1 + dimensions, 0.3, -0.9);
  basis.origin = Vec3(0.1, dimensions > 1 ? -0.2 : 0, 0);
  basis.size = 1.3;
  return basis;
}

Vec3 somewhere(std::mt19937& generator, int dimensions) {
  std::uniform_real_distribution<Real> uniform(-0.5, 0.5);
  Vec3 p = Vec3::Zero();
  for (int k = 0; k < dimensions; ++k) p[k] = uniform(generator);
  return p;
}

}  // namespace

TEST(RadialKernel, derivatives_are_those_of_finite_differences) {
  constexpr Real h = 1e-5;
  for (const RadialKernel& kernel : all_kernels())
    for (const Real r : {0.05, 0.2, 0.41, 0.7, 0.79, 0.81, 1.5}) {
      const auto at = [&](Real x) { return radial_profile(kernel, reach, x); };
      const RadialProfile found = at(r);
      const auto near = [&](Real expected, Real value) {
        EXPECT_NEAR(value, expected, 1e-6 * (1 + std::abs(expected))) << name_of(kernel) << " at " << r;
      };
      near((at(r + h).value - at(r - h).value) / (2 * h), found.slope);
      near((at(r + h).slope - at(r - h).slope) / (2 * h), found.second);
      near((at(r + h).second - at(r - h).second) / (2 * h), found.third);
      near(found.slope / r, found.slope_over_r);
      EXPECT_EQ(found.value, radial_value(kernel, reach, r));
    }
}

TEST(RadialKernel, values_at_half_of_the_reach_are_those_of_the_published_forms) {
  // (1 - s)^n times a polynomial in s, numbers 1 to 10 of table 3.1; number 9 as in Wendland 1995.
  const Real at_half[] = {1. / 2,     2.5 / 8,     5.5 / 32, 1. / 4,   3. / 16,
                          20.75 / 64, 15.25 / 256, 1. / 8,   3.5 / 32, 8.5 / 128};
  for (std::size_t i = 0; i < 10; ++i)
    EXPECT_NEAR(radial_value({static_cast<RadialShape>(i)}, reach, reach / 2), at_half[i], 1e-15) << i;
  EXPECT_NEAR(radial_value({RadialShape::gaussian}, reach, reach / 2), std::exp(-0.25), 1e-15);
  EXPECT_NEAR(radial_value({RadialShape::thin_plate}, reach, 2 * reach), 4 * std::log(2.0), 1e-14);
  EXPECT_NEAR(radial_value({RadialShape::power_minus_1, 3}, reach, 2 * reach), 28, 1e-13);
}

TEST(RadialKernel, what_is_four_times_differentiable_has_no_third_derivative_at_its_center) {
  for (const RadialShape shape : {RadialShape::wendland_12, RadialShape::wendland_32, RadialShape::wendland_33,
                                  RadialShape::wendland_52, RadialShape::gaussian})
    EXPECT_NEAR(radial_profile({shape}, reach, 0).third, 0, 1e-10) << static_cast<int>(shape);
}

TEST(RadialKernel, limits_at_the_center_are_reached_from_beside_it) {
  for (const RadialKernel& kernel : all_kernels()) {
    const RadialProfile at = radial_profile(kernel, reach, 0), beside = radial_profile(kernel, reach, 1e-7);
    EXPECT_NEAR(at.value, beside.value, 1e-6) << name_of(kernel);
    EXPECT_NEAR(at.slope, beside.slope, 1e-5) << name_of(kernel);
    if (kernel.shape == RadialShape::thin_plate) {
      EXPECT_EQ(at.slope_over_r, -std::numeric_limits<Real>::infinity());
      EXPECT_EQ(at.second, -std::numeric_limits<Real>::infinity());
    } else if (has_kink(kernel.shape)) {
      EXPECT_EQ(at.slope_over_r, -std::numeric_limits<Real>::infinity()) << name_of(kernel);
      EXPECT_NEAR(at.second, beside.second, 1e-4) << name_of(kernel);
    } else {
      EXPECT_NEAR(at.slope_over_r, beside.slope_over_r, 1e-4) << name_of(kernel);
      EXPECT_NEAR(at.second, beside.second, 1e-4) << name_of(kernel);
      EXPECT_NEAR(at.second, at.slope_over_r, 1e-12) << name_of(kernel) << ": the same in all directions";
    }
  }
}

TEST(RadialKernel, kernels_that_end_do_so_smoothly_and_are_largest_at_their_center) {
  for (const RadialKernel& kernel : all_kernels()) {
    if (!is_compact(kernel)) continue;
    EXPECT_EQ(radial_value(kernel, reach, reach), 0);
    EXPECT_EQ(radial_value(kernel, reach, 2 * reach), 0);
    EXPECT_NEAR(radial_value(kernel, reach, 0.999 * reach), 0, 0.0011);
    for (Real r = 0.01; r < 1; r += 0.01)
      EXPECT_LE(radial_value(kernel, reach, r), radial_value(kernel, reach, r - 0.01)) << name_of(kernel) << r;
  }
}

TEST(RadialBasis, gradient_and_hessian_are_those_of_finite_differences) {
  constexpr Real h = 1e-5;
  for (const RadialKernel& kernel : all_kernels())
    for (const int dimensions : {1, 2, 3}) {
      const RadialBasis basis = some_basis(kernel, dimensions);
      std::mt19937 generator(7);
      for (int trial = 0; trial < 8; ++trial) {
        const Vec3 p = somewhere(generator, dimensions);
        // Beside a center derivatives change too fast for differences.
        if ((basis.centers.colwise() - p).colwise().norm().minCoeff() < 0.02) continue;
        const RadialSample found = sample(basis, p);
        EXPECT_NEAR(found.value, value_at(basis, p), 1e-14);
        EXPECT_LT((found.gradient - slope_at(basis, p).gradient).norm(), 1e-14);
        for (int k = 0; k < dimensions; ++k) {
          const Vec3 step = h * Vec3::Unit(k);
          const RadialSample after = sample(basis, p + step), before = sample(basis, p - step);
          const Real slope = (after.value - before.value) / (2 * h);
          EXPECT_NEAR(found.gradient[k], slope, 1e-6 * (1 + std::abs(slope))) << name_of(kernel);
          const Vec3 bend = (after.gradient - before.gradient) / (2 * h);
          EXPECT_LT((found.hessian.col(k) - bend).norm(), 1e-6 * (1 + bend.norm())) << name_of(kernel) << dimensions;
        }
        EXPECT_NEAR(field_curvature(basis, p), found.hessian.trace() / dimensions, 1e-12 * found.hessian.norm());
      }
    }
}

TEST(RadialBasis, at_a_center_derivatives_are_finite_where_the_kernel_is_smooth) {
  for (const RadialKernel& kernel : all_kernels()) {
    const RadialBasis basis = some_basis(kernel, 3);
    const RadialSample at = sample(basis, basis.centers.col(4));
    EXPECT_TRUE(std::isfinite(at.value)) << name_of(kernel);
    EXPECT_TRUE(at.gradient.allFinite()) << name_of(kernel);
    const bool is_smooth = !has_kink(kernel.shape) && kernel.shape != RadialShape::thin_plate;
    EXPECT_EQ(at.hessian.allFinite(), is_smooth) << name_of(kernel);
    if (!is_smooth) continue;
    const RadialSample beside = sample(basis, basis.centers.col(4) + Vec3::Constant(1e-7));
    EXPECT_LT((at.hessian - beside.hessian).norm(), 1e-4 * (1 + at.hessian.norm())) << name_of(kernel);
  }
}

TEST(RadialBasis, spheres_around_one_center_have_the_curvature_of_spheres) {
  RadialBasis basis;
  basis.centers = Vec3(0.1, 0.2, -0.3);
  basis.reaches = Eigen::VectorXd::Constant(1, 1);
  basis.weights = Eigen::VectorXd::Constant(1, -1);  // grows outwards
  for (const Real r : {0.1, 0.4, 1.0}) {
    const RadialSample at = sample(basis, Vec3(0.1, 0.2, -0.3) + r * Vec3(1, 2, -2) / 3);
    EXPECT_NEAR(surface_mean_curvature(at), 1 / r, 1e-10 / r);
  }
}

}  // namespace gracilis
