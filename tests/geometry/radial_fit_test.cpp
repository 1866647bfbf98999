#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/radial_fit.hpp>
#include <gracilis/geometry/radial_sparse.hpp>

#include "radial_kernels.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <cmath>
#include <random>

namespace gracilis {
namespace {

Points scattered(Index count, int dimensions, unsigned seed = 3) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<Real> uniform(-1, 1);
  Points points = Points::Zero(3, count);
  for (Index i = 0; i < count; ++i)
    for (int k = 0; k < dimensions; ++k) points(k, i) = uniform(generator);
  return points;
}

Eigen::VectorXd values_of(const Points& points, const std::function<Real(const Vec3&)>& f) {
  Eigen::VectorXd values(points.cols());
  for (Index i = 0; i < static_cast<Index>(points.cols()); ++i) values[i] = f(points.col(i));
  return values;
}

Real wave(const Vec3& p) { return std::sin(2 * p.x() + 0.3) * std::cos(1.5 * p.y()) + 0.5 * p.z() * p.z(); }

}  // namespace

TEST(RadialFit, interpolation_meets_its_samples_to_1e_10_with_every_kernel) {
  for (const int dimensions : {1, 2, 3}) {
    const Points points = scattered(dimensions == 1 ? 12 : 80, dimensions);
    const Eigen::VectorXd values = values_of(points, wave);
    for (const RadialKernel& kernel : all_kernels())
      for (const RadialPolynomial polynomial :
           {RadialPolynomial::none, RadialPolynomial::constant, RadialPolynomial::linear}) {
        const Real reach = is_compact(kernel) ? 0.9 : 0.25;
        const RadialFit fit = interpolate({kernel, polynomial, dimensions}, points, reach, values);
        for (Index i = 0; i < static_cast<Index>(points.cols()); ++i)
          EXPECT_NEAR(value_at(fit.basis, points.col(i)), values[i], 1e-10)
              << static_cast<int>(kernel.shape) << " in " << dimensions;
        EXPECT_LT(fit.largest_residual, 1e-10);
        EXPECT_GE(fit.condition, 1);
      }
  }
}

TEST(RadialFit, polynomials_are_reproduced_to_1e_12) {
  for (const int dimensions : {1, 2, 3}) {
    const Points points = scattered(dimensions == 1 ? 15 : 60, dimensions), elsewhere = scattered(20, dimensions, 9);
    const auto line = [dimensions](const Vec3& p) {
      return 0.7 - 0.4 * p.x() + 0.9 * p.y() * (dimensions > 1) - p.z();
    };
    const auto constant = [](const Vec3&) { return 0.7; };
    const Points centers = points.leftCols(points.cols() / 3);
    for (const RadialKernel& kernel : all_kernels()) {
      const Real reach = is_compact(kernel) ? 0.9 : 0.3;
      const Eigen::VectorXd reaches = Eigen::VectorXd::Constant(centers.cols(), reach);
      const RadialFitSettings with_constant{kernel, RadialPolynomial::constant, dimensions},
          with_line{kernel, RadialPolynomial::linear, dimensions};
      const RadialBasis a = interpolate(with_constant, points, reach, values_of(points, constant)).basis;
      const RadialBasis b = interpolate(with_line, points, reach, values_of(points, line)).basis;
      const RadialBasis c = fit_least_squares(with_line, centers, reaches, points, values_of(points, line)).basis;
      for (Index i = 0; i < static_cast<Index>(elsewhere.cols()); ++i) {
        const Vec3 p = elsewhere.col(i);
        EXPECT_NEAR(value_at(a, p), 0.7, 1e-12) << static_cast<int>(kernel.shape) << " in " << dimensions;
        EXPECT_NEAR(value_at(b, p), line(p), 1e-12) << static_cast<int>(kernel.shape) << " in " << dimensions;
        EXPECT_NEAR(value_at(c, p), line(p), 1e-12) << static_cast<int>(kernel.shape) << " in " << dimensions;
      }
    }
  }
}

TEST(RadialFit, least_squares_leave_what_is_orthogonal_to_all_functions) {
  const Points points = scattered(300, 3), centers = scattered(40, 3, 8);
  const Eigen::VectorXd values = values_of(points, wave), reaches = Eigen::VectorXd::Constant(40, 0.5);
  const RadialFit fit =
      fit_least_squares({{RadialShape::gaussian}, RadialPolynomial::linear}, centers, reaches, points, values);
  Eigen::VectorXd left(300);
  for (Index i = 0; i < 300; ++i) left[i] = values[i] - value_at(fit.basis, points.col(i));
  EXPECT_GT(left.norm(), 1e-4) << "nothing is left to judge";
  for (Index j = 0; j < 40; ++j) {
    Real product = 0;
    for (Index i = 0; i < 300; ++i)
      product += left[i] * radial_value({RadialShape::gaussian}, 0.5, (points.col(i) - centers.col(j)).norm());
    EXPECT_NEAR(product, 0, 1e-10);
  }
  EXPECT_NEAR(left.sum(), 0, 1e-10);
}

TEST(RadialFit, weights_of_points_count) {
  const Points points = scattered(100, 3), centers = scattered(10, 3, 8);
  const Eigen::VectorXd values = values_of(points, wave), reaches = Eigen::VectorXd::Constant(10, 0.5);
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(100);
  weights[7] = 1e4;
  const RadialFitSettings settings{{RadialShape::gaussian}};
  const RadialFit even = fit_least_squares(settings, centers, reaches, points, values);
  const RadialFit uneven = fit_least_squares(settings, centers, reaches, points, values, weights);
  EXPECT_GT(std::abs(value_at(even.basis, points.col(7)) - values[7]), 1e-3);
  EXPECT_LT(std::abs(value_at(uneven.basis, points.col(7)) - values[7]), 1e-6);
}

TEST(RadialFit, the_condition_is_that_of_the_matrix) {
  const Points points = scattered(40, 3);
  for (const RadialShape shape : {RadialShape::wendland_31, RadialShape::gaussian}) {
    const Real reach = shape == RadialShape::gaussian ? 0.4 : 1.0;
    Eigen::MatrixXd matrix(40, 40);
    for (Index i = 0; i < 40; ++i)
      for (Index j = 0; j < 40; ++j)
        matrix(i, j) = radial_value({shape}, reach, (points.col(i) - points.col(j)).norm());
    const RadialFit fit = interpolate({{shape}}, points, reach, values_of(points, wave));
    const Eigen::VectorXd singular = Eigen::JacobiSVD<Eigen::MatrixXd>(matrix).singularValues();
    const Real in_2_norm = singular[0] / singular[39];
    const Real in_1_norm = matrix.cwiseAbs().colwise().sum().maxCoeff() *
                           Eigen::MatrixXd(matrix.inverse()).cwiseAbs().colwise().sum().maxCoeff();
    if (shape == RadialShape::wendland_31) {
      EXPECT_NEAR(fit.condition / in_2_norm, 1, 0.02);
    } else {
      EXPECT_LE(fit.condition, in_1_norm * 1.001) << "an estimate from below";
      EXPECT_GT(fit.condition, in_1_norm / 3);
    }
  }
}

TEST(RadialFit, a_singular_system_is_an_error_that_says_so) {
  Points twice = scattered(20, 3);
  twice.col(5) = twice.col(11);
  const Eigen::VectorXd values = values_of(twice, wave);
  const auto message = [&](const RadialFitSettings& settings, const Points& points, Real reach) -> std::string {
    try {
      interpolate(settings, points, reach, values);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  using testing::HasSubstr;
  const Points apart = scattered(20, 3), in_a_plane = scattered(20, 2);
  EXPECT_THAT(message({{RadialShape::gaussian}}, twice, 0.5), HasSubstr("singular"));
  EXPECT_THAT(message({{RadialShape::wendland_31}}, twice, 0.9), HasSubstr("singular"));
  EXPECT_THAT(message({{RadialShape::gaussian}}, apart, 1e5), HasSubstr("singular"));
  // r^4 - r^2 is a polynomial of 30 terms in the plane's coordinates at both ends, and of fewer ranks.
  EXPECT_THAT(message({{RadialShape::power_minus_1, 2}}, in_a_plane, 1), HasSubstr("singular"));
  EXPECT_EQ(message({{RadialShape::power_minus_1, 1.7}, RadialPolynomial::linear, 2}, in_a_plane, 1), "no error");
  // A plane does not tell how a line goes on beside it.
  EXPECT_THAT(message({{RadialShape::gaussian}, RadialPolynomial::linear, 3}, in_a_plane, 0.3), HasSubstr("singular"));
}

TEST(RadialFit, fewer_points_than_unknowns_are_an_error) {
  const Points points = scattered(10, 3);
  EXPECT_THROW(fit_least_squares({}, scattered(11, 3, 4), Eigen::VectorXd::Ones(11), points, values_of(points, wave)),
               InputError);
}

// As a full matrix it would take 20 GB.
TEST(RadialFit, systems_of_50000_centers_are_solved_as_sparse_ones) {
  const Points points = scattered(50000, 3);
  const Eigen::VectorXd values = values_of(points, wave);
  const RadialFit fit = interpolate({{RadialShape::wendland_31}, RadialPolynomial::linear}, points, 0.12, values);
  RecordProperty("condition", std::to_string(fit.condition));
  EXPECT_LT(fit.largest_residual, 1e-10);
}

TEST(RadialFit, sparse_solutions_have_the_same_bits_for_any_number_of_threads) {
  const Points points = scattered(3000, 3);
  const Eigen::VectorXd values = values_of(points, wave);
  const auto solve = [&](int threads) {
    const ThreadLimit limit(threads);
    return interpolate({{RadialShape::wendland_31}, RadialPolynomial::linear}, points, 0.3, values).basis.weights;
  };
  EXPECT_EQ(solve(1), solve(2));
}

TEST(SparseKernelSolver, solves_what_the_whole_matrix_does_whether_it_is_positive_definite_or_not) {
  std::mt19937 chance(12);
  std::uniform_real_distribution<Real> uniform(0, 1);
  Points centers(3, 80);
  for (Real& coordinate : centers.reshaped()) coordinate = uniform(chance);
  const Real reach = 0.6;
  // In space kernels for one dimension need not be positive definite.
  for (const RadialShape shape : {RadialShape::wendland_31, RadialShape::wendland_33, RadialShape::wendland_12}) {
    const RadialKernel kernel{shape};
    Eigen::MatrixXd whole(80, 80);
    for (Index i = 0; i < 80; ++i)
      for (Index j = 0; j < 80; ++j)
        whole(i, j) = radial_value(kernel, reach, (centers.col(i) - centers.col(j)).norm());
    const SparseKernelSolver solver(kernel, centers, reach);
    const Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(80, -1, 2);
    EXPECT_LT((solver.times(right) - whole * right).norm(), 1e-13 * (whole * right).norm());
    const Eigen::VectorXd found = solver.solve(right);
    EXPECT_LT((whole * found - right).norm(), 1e-12 * right.norm());
    const Eigen::VectorXd sizes = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(whole).eigenvalues().cwiseAbs();
    const Real condition = sizes.maxCoeff() / sizes.minCoeff();
    EXPECT_LT(solver.condition(), 1.01 * condition) << "estimated from below";
    EXPECT_GT(solver.condition(), 0.5 * condition);
    EXPECT_TRUE(solver.solve(Eigen::VectorXd::Zero(80)).isZero());
  }
}

TEST(SparseKernelSolver, centers_that_coincide_have_no_condition) {
  Points centers = Points::Zero(3, 2);
  EXPECT_GT(SparseKernelSolver({RadialShape::wendland_31}, centers, 1).condition(), 1e12);
}

}  // namespace gracilis
