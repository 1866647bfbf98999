#include <gracilis/geometry/rbf_centers.hpp>
#include <gracilis/geometry/rbf_feature_centers.hpp>

#include <height_fields.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace gracilis {
namespace {

Real error_with(const HeightField& field, const Points& centers) {
  const Eigen::VectorXd reaches = Eigen::VectorXd::Constant(centers.cols(), 0.17);
  const RadialFit fit = fit_least_squares({{RadialShape::gaussian}, RadialPolynomial::linear, 2}, centers, reaches,
                                          field.nodes(), field.heights);
  return mean_squared_error(fit.basis, field.nodes(), field.heights);
}

}  // namespace

TEST(RbfCenters, a_grid_reaches_from_corner_to_corner) {
  const Eigen::AlignedBox3d box(Vec3(-1, 0, 2), Vec3(1, 3, 2));
  const Points grid = grid_centers(box, {3, 4, 1});
  ASSERT_EQ(grid.cols(), 12);
  EXPECT_EQ(Vec3(grid.col(0)), box.min());
  EXPECT_EQ(Vec3(grid.col(11)), box.max());
  EXPECT_LT((grid.col(1) - Vec3(0, 0, 2)).norm(), 1e-15);
}

TEST(RbfCenters, the_halton_sequence_begins_as_published) {
  const Points points = halton_centers({Vec3::Zero(), Vec3::Ones()}, 5);
  EXPECT_LT((points.row(0).transpose() - Eigen::Matrix<Real, 5, 1>(1. / 2, 1. / 4, 3. / 4, 1. / 8, 5. / 8)).norm(),
            1e-15);
  EXPECT_LT((points.row(1).transpose() - Eigen::Matrix<Real, 5, 1>(1. / 3, 2. / 3, 1. / 9, 4. / 9, 7. / 9)).norm(),
            1e-15);
  EXPECT_NEAR(points(2, 4), 1. / 25, 1e-15);
}

TEST(RbfCenters, extrema_are_the_tops_and_bottoms) {
  const Points found = extremum_centers(
      field_of([](Real x, Real y) { return std::sin(2 * pi * x + 1e-3) * std::sin(2 * pi * y + 1e-3); }));
  ASSERT_EQ(found.cols(), 4);
  for (Index i = 0; i < 4; ++i)
    for (int k = 0; k < 2; ++k) EXPECT_NEAR(std::abs(found(k, i) - 0.5), 0.25, 1e-9);
  EXPECT_EQ(extremum_centers(field_of([](Real x, Real y) { return x + y; })).cols(), 0);
}

TEST(RbfCenters, inflection_is_where_the_curvature_changes_its_sign) {
  const Points found = inflection_centers(field_of([](Real x, Real) { return std::pow(x - 0.5, 3); }));
  ASSERT_GT(found.cols(), 30);
  for (Index i = 0; i < static_cast<Index>(found.cols()); ++i) EXPECT_NEAR(found(0, i), 0.5, 1e-9);
  EXPECT_EQ(inflection_centers(field_of([](Real x, Real y) { return x * x + y * y; })).cols(), 0);
}

TEST(RbfCenters, curvature_is_stationary_at_the_top_of_a_bump) {
  const Points found = curvature_centers(
      field_of([](Real x, Real y) { return std::exp(-30 * ((x - 0.5) * (x - 0.5) + (y - 0.4) * (y - 0.4))); }));
  Real nearest = 1;
  for (Index i = 0; i < static_cast<Index>(found.cols()); ++i)
    nearest = std::min(nearest, (found.col(i) - Vec3(0.5, 0.4, 0)).norm());
  EXPECT_LT(nearest, 1e-9);
}

TEST(RbfCenters, edges_are_where_the_field_is_steepest) {
  const Points found = edge_centers(field_of([](Real x, Real y) { return std::tanh(20 * (x + 0.2 * y - 0.6)); }));
  ASSERT_GT(found.cols(), 30);
  for (Index i = 0; i < static_cast<Index>(found.cols()); ++i)
    EXPECT_NEAR(found(0, i) + 0.2 * found(1, i), 0.6, 0.026) << "more than one node beside the edge";
}

TEST(RbfCenters, borders_have_their_corners) {
  const Points found = border_centers(field_of(franke), 3);
  ASSERT_EQ(found.cols(), 16);
  for (Index i = 0; i < 16; ++i) {
    const Vec3 from_middle = found.col(i) - Vec3(0.5, 0.5, 0);
    EXPECT_NEAR(from_middle.cwiseAbs().maxCoeff(), 0.5, 1e-12);
  }
  EXPECT_EQ(Vec3(found.col(8)), Vec3(1, 1, 0));
}

TEST(RbfCenters, spreading_takes_each_point_once_and_the_farthest_next) {
  Points points(3, 5);
  points << 0, 0, 10, 4, 10, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0;
  const Points spread = spread_out(points, 9);
  ASSERT_EQ(spread.cols(), 3);
  EXPECT_EQ(spread(0, 1), 10);
  EXPECT_EQ(spread(0, 2), 4);
  EXPECT_EQ(filled_up(points, 20, {Vec3::Zero(), Vec3::Constant(10)}).cols(), 20);
}

TEST(RbfCenters, greedy_fits_get_better_with_every_center_and_choose_reaches) {
  const HeightField field = field_of(franke);
  const RadialFitSettings settings{{RadialShape::gaussian}, RadialPolynomial::linear, 2};
  Real last = 1;
  for (const Index count : {4, 8, 16, 32}) {
    const RadialFit fit = fit_greedily(settings, field.nodes(), field.heights, {0.06, 0.12, 0.25, 0.4}, count);
    ASSERT_EQ(fit.basis.count(), count);
    const Real error = mean_squared_error(fit.basis, field.nodes(), field.heights);
    EXPECT_LT(error, last);
    last = error;
    EXPECT_LT(fit.basis.reaches.minCoeff(), fit.basis.reaches.maxCoeff());
  }
  EXPECT_LT(last, 2e-4);
}

TEST(RbfCenters, on_frankes_field_extrema_with_the_halton_sequence_do_better_than_a_grid_of_as_many) {
  const HeightField field = field_of(franke);
  const Real grid = error_with(field, grid_centers(field.box(), {8, 8, 1}));
  const Real extrema = error_with(field, filled_up(extremum_centers(field), 64, field.box()));
  EXPECT_LT(extrema, 0.6 * grid);
}

}  // namespace gracilis
