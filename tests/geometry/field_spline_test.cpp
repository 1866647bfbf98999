#include <gracilis/geometry/field_spline.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <random>

namespace gracilis {
namespace {

const DistanceField& field() {
  static const DistanceField built = [] {
    const TriangleMesh ball = shapes::sphere(Vec3::Zero(), 0.02, 4);
    return build_distance_field(ball, domain_by_cell_size(ball, 0.0025, 0.02));
  }();
  return built;
}

std::vector<Vec3> places(Real reach) {
  std::mt19937 random(1);
  std::uniform_real_distribution<Real> along(-reach, reach);
  std::vector<Vec3> all(200);
  for (Vec3& place : all) place = Vec3(along(random), along(random), along(random));
  return all;
}

/// Cells of different sizes and numbers along the axes, with values in meters.
DistanceField sampled_field(const std::function<Real(const Vec3&)>& value) {
  DistanceField made;
  made.origin = Vec3(0.1, -0.2, 0.3);
  made.cell_size = Vec3(0.001, 0.002, 0.004);
  made.nodes = {7, 6, 5};
  for (Index k = 0; k < 5; ++k)
    for (Index j = 0; j < 6; ++j)
      for (Index i = 0; i < 7; ++i)
        made.values.push_back(static_cast<float>(value(made.origin + made.cell_size.cwiseProduct(Vec3(i, j, k)))));
  return made;
}

TEST(FieldSpline, squares_come_out_a_quarter_of_a_cell_squared_higher_and_products_as_they_are) {
  // Σ i² B(x - i) = x² + 1/4; what is linear along each axis stays.
  const auto square = [](Real x) { return x * x; };
  const auto value = [&](const Vec3& p) {
    const Real x = 1000 * (p.x() - 0.1), y = 500 * (p.y() + 0.2), z = 250 * (p.z() - 0.3);  // in cells
    return 1 + 2 * x - y + 3 * z + x * y - 2 * y * z + 0.5 * x * y * z + 3 * square(x) - 2 * square(y) + square(z);
  };
  const DistanceField made = sampled_field(value);
  const Real higher = (3.0 - 2.0 + 1.0) / 4;
  for (const Vec3& cells : {Vec3(2.3, 2.4, 1.7), Vec3(0.6, 4.4, 3.4), Vec3(5.4, 0.6, 0.6)}) {
    const Vec3 p = made.origin + made.cell_size.cwiseProduct(cells);
    const CurvedSample found = sample_spline_curved(grid_of(made), p);
    EXPECT_NEAR(found.distance, value(p) + higher, 1e-4) << "values in single precision, up to 200";
    EXPECT_NEAR(sample_spline_precise(grid_of(made), p).distance, found.distance, 1e-10);
    const Vec3 scale = made.cell_size.cwiseInverse();
    const Real x = cells.x(), y = cells.y(), z = cells.z();
    const Vec3 gradient(2 + y + 0.5 * y * z + 6 * x, -1 + x - 2 * z + 0.5 * x * z - 4 * y,
                        3 - 2 * y + 0.5 * x * y + 2 * z);
    EXPECT_LT((found.gradient - gradient.cwiseProduct(scale)).norm(), 1e-5 * found.gradient.norm());
    Eigen::Matrix3d bend;
    bend << 6, 1 + 0.5 * z, 0.5 * y, 1 + 0.5 * z, -4, -2 + 0.5 * x, 0.5 * y, -2 + 0.5 * x, 2;
    EXPECT_LT((found.curvature - scale.asDiagonal() * bend * scale.asDiagonal()).norm(), 1e-5 * found.curvature.norm());
  }
}

TEST(FieldSpline, in_the_outermost_cells_is_the_trilinear_interpolant) {
  const DistanceField made = sampled_field([](const Vec3& p) { return p.squaredNorm(); });
  const auto at = [&](Real x, Real y, Real z) -> Vec3 {
    return made.origin + made.cell_size.cwiseProduct(Vec3(x, y, z));
  };
  for (const Vec3& p : {at(0.3, 2.5, 2.5), at(5.7, 2.5, 2.5), at(2.5, 0.3, 2.5), at(2.5, 4.7, 2.5), at(2.5, 2.5, 0.3),
                        at(2.5, 2.5, 3.7)}) {
    const FieldSample flat = sample(made, Eigen::Vector3f(p.cast<float>()));
    EXPECT_EQ(sample_spline(grid_of(made), p.cast<float>()).distance, flat.distance) << p.transpose();
    EXPECT_EQ(sample_spline_precise(grid_of(made), p).distance, static_cast<Real>(flat.distance));
    EXPECT_EQ(sample_spline_curved(grid_of(made), p).distance, static_cast<Real>(flat.distance));
    EXPECT_TRUE(sample_spline_curved(grid_of(made), p).curvature.isZero());
  }
  EXPECT_EQ(sample_spline_precise(grid_of(made), at(7, 1, 1)).distance, std::numeric_limits<Real>::infinity());
}

TEST(FieldSpline, is_near_the_distance) {
  for (const Vec3& place : places(0.03)) {
    if (place.norm() < 0.012) continue;
    EXPECT_NEAR(sample_spline_curved(grid_of(field()), place).distance, place.norm() - 0.02, 3e-4);
  }
}

TEST(FieldSpline, single_and_double_precision_agree) {
  for (const Vec3& place : places(0.03)) {
    const CurvedSample fine = sample_spline_curved(grid_of(field()), place);
    const FieldSample fast = sample_spline(grid_of(field()), place.cast<float>());
    EXPECT_NEAR(static_cast<Real>(fast.distance), fine.distance, 1e-7);
    EXPECT_LT((fast.gradient.cast<Real>() - fine.gradient).norm(), 1e-4);
    const PreciseSample precise = sample_spline_precise(grid_of(field()), place);
    EXPECT_NEAR(precise.distance, fine.distance, 1e-12);
    EXPECT_LT((precise.gradient - fine.gradient).norm(), 1e-9);
  }
}

TEST(FieldSpline, derivatives_are_those_of_its_values) {
  const FieldGrid grid = grid_of(field());
  constexpr Real step = 1e-6;
  for (const Vec3& place : places(0.03)) {
    const CurvedSample here = sample_spline_curved(grid, place);
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 along = step * Vec3::Unit(axis);
      const CurvedSample ahead = sample_spline_curved(grid, place + along),
                         behind = sample_spline_curved(grid, place - along);
      EXPECT_NEAR(here.gradient[axis], (ahead.distance - behind.distance) / (2 * step), 2e-4);
      EXPECT_LT((here.curvature.col(axis) - (ahead.gradient - behind.gradient) / (2 * step)).norm(), 0.6)
          << "1/m; of some 50, where a step crosses the border of a cell half of the jump";
    }
  }
}

TEST(FieldSpline, the_gradient_has_no_jumps) {
  const FieldGrid grid = grid_of(field());
  constexpr Real step = 1e-5;
  Vec3 last = sample_spline_curved(grid, Vec3(-0.03, 0.011, 0.013)).gradient;
  for (Real x = -0.03 + step; x < 0.03; x += step) {
    const Vec3 now = sample_spline_curved(grid, Vec3(x, 0.011, 0.013)).gradient;
    EXPECT_LT((now - last).norm(), 1e-3) << x;
    last = now;
  }
}

TEST(FieldSpline, beyond_the_grid_it_is_a_lower_bound) {
  const BoundedField around = bounded(field());
  const FieldSample far = sample_spline_bounded(around, Eigen::Vector3f(0.3f, 0, 0));
  EXPECT_LT(far.distance, 0.28f + 1e-6f);
  EXPECT_GT(far.distance, 0.2f);
  EXPECT_TRUE(far.gradient.isZero(0));
  const Eigen::Vector3f edge = (field().origin + Vec3::Constant(0.0005)).cast<float>();
  EXPECT_EQ(sample_spline_bounded(around, edge).distance, sample_bounded(around, edge).distance);
}

}  // namespace
}  // namespace gracilis
