#include <gracilis/geometry/field_spline.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

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
