#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/area_samples.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/thin_plate.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace gracilis {
namespace {

Points some_points() {
  Points points(3, 60);
  for (Index i = 0; i < 60; ++i) points.col(i) = Vec3(std::sin(7.0 * i), std::cos(3.1 * i), std::sin(1.7 * i + 1)) / 10;
  return points;
}

PlaceTargets targets_at(const Points& points, const Points& places) {
  return {points, places, Points::Zero(3, points.cols()), Eigen::VectorXd::Ones(points.cols()), 1};
}

TEST(ThinPlate, affine_maps_cost_nothing_however_stiff_it_is) {
  const Points points = some_points();
  Eigen::Matrix3d linear;
  linear << 1.1, 0.2, 0, -0.1, 0.9, 0.3, 0, 0.1, 1.3;
  Points places = (linear * points).colwise() + Vec3(1, 2, 3);
  const ThinPlateMap map = fit_thin_plate(ThinPlateBasis(points.leftCols(20)), targets_at(points, places), 1e6);
  EXPECT_LT((map.at(points) - places).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_LT((map.slope(Vec3(0.5, 0.5, 0.5)) - linear).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(ThinPlate, without_stiffness_points_come_where_they_should_and_the_slope_is_that_of_the_map) {
  const Points points = some_points();
  Points places = points;
  for (auto place : places.colwise()) place += Vec3(place.y() * place.y(), std::sin(9 * place.x()) / 50, 0);
  const ThinPlateMap map = fit_thin_plate(ThinPlateBasis(points), targets_at(points, places), 1e-12);
  EXPECT_LT((map.at(points) - places).cwiseAbs().maxCoeff(), 1e-5);
  const Vec3 p(0.03, -0.02, 0.05), step(1e-6, 0, 0);
  const Vec3 difference = (map.at(Vec3(p + step)) - map.at(Vec3(p - step))) / 2e-6;
  EXPECT_LT((map.slope(p).col(0) - difference).norm(), 1e-6);
}

TEST(ThinPlate, along_the_surface_points_are_free) {
  const Points points = some_points();
  PlaceTargets targets = targets_at(points, points.colwise() + Vec3(0.01, 0.02, 0.03));
  targets.normals.row(2).setOnes();
  targets.along_surface = 0;
  const ThinPlateMap map = fit_thin_plate(ThinPlateBasis(points.leftCols(20)), targets, 1e-3);
  const Points moved = map.at(points) - points;
  EXPECT_LT((moved.row(2).array() - 0.03).abs().maxCoeff(), 1e-6);
  EXPECT_LT(moved.topRows(2).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(ThinPlate, a_point_with_a_normal_pulls_along_the_surface_by_its_share_and_one_without_in_all_directions) {
  // Each place twice: once with a normal and pulled by `along`, once without and pulled by `other`. Affine maps alone.
  const Points places = some_points();
  const Index n = static_cast<Index>(places.cols());
  const Vec3 normal = Vec3(1, 2, 2) / 3, pull = Vec3(0.01, -0.02, 0.05), other = Vec3(0.03, 0.01, -0.02);
  PlaceTargets targets;
  targets.points.resize(3, 2 * n);
  targets.points << places, places;
  targets.places.resize(3, 2 * n);
  targets.places << places.colwise() + pull, places.colwise() + other;
  targets.normals = Points::Zero(3, 2 * n);
  targets.normals.leftCols(n).colwise() = normal;
  targets.weights = Eigen::VectorXd::Ones(2 * n);
  targets.weights.tail(n).setConstant(3);
  for (const Real share : {0.0, 0.25, 1.0}) {
    targets.along_surface = share;
    const ThinPlateMap map = fit_thin_plate(ThinPlateBasis(Points(3, 0)), targets, 1);
    // Across the surface the two pull by 1 and 3, along it by `share` and 3.
    const Vec3 across = (pull + 3 * other) / 4, along = (share * pull + 3 * other) / (share + 3);
    const Vec3 expected = normal * normal.dot(across) + along - normal * normal.dot(along);
    EXPECT_LT((map.at(places) - (places.colwise() + expected)).cwiseAbs().maxCoeff(), 1e-8) << share;
  }
}

TEST(ThinPlate, the_stiffer_it_is_the_less_it_bends_and_the_worse_it_fits) {
  const Points points = some_points();
  Points places = points;
  for (auto place : places.colwise()) place.z() += place.x() * place.y();
  PlaceTargets targets = targets_at(points, places);
  for (const Real along : {1.0, 0.999999}) {
    targets.along_surface = along;
    Real missed = 0;
    for (const Real stiffness : {1e-6, 1e-3, 1.0, 1e3}) {
      const ThinPlateMap map = fit_thin_plate(ThinPlateBasis(points), targets, stiffness);
      const Real now = (map.at(points) - places).squaredNorm();
      EXPECT_GT(now, missed) << stiffness;
      missed = now;
    }
    const ThinPlateMap affine = fit_thin_plate(ThinPlateBasis(Points(3, 0)), targets, 1);
    EXPECT_NEAR(missed / (affine.at(points) - places).squaredNorm(), 1, 1e-2) << "in the end it is an affine map";
  }
}

TEST(ThinPlate, whether_directions_count_alike_is_told_the_same_by_both_ways_to_solve_it) {
  const Points points = some_points();
  Points places = points;
  for (auto place : places.colwise()) place.z() += place.x() * place.y();
  PlaceTargets targets = targets_at(points, places);
  targets.weights = Eigen::VectorXd::LinSpaced(points.cols(), 1, 3);
  const ThinPlateBasis basis(points.leftCols(20));
  const Points one_by_one = fit_thin_plate(basis, targets, 1e-2).at(points);
  targets.along_surface = 0;  // of no account where there are no normals
  const Points together = fit_thin_plate(basis, targets, 1e-2).at(points);
  EXPECT_LT((one_by_one - together).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(ThinPlate, the_weights_of_its_kernels_are_such_that_no_affine_map_sees_them) {
  const Points centers = some_points().leftCols(20);
  const ThinPlateBasis basis(centers);
  const Eigen::MatrixXd weights = basis.kernel_weights(Eigen::MatrixXd::Random(basis.count(), 3)).topRows(20);
  EXPECT_LT(weights.colwise().sum().cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((centers * weights).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(ThinPlate, points_that_coincide_are_refused) {
  Points centers = some_points().leftCols(10);
  centers.col(3) = centers.col(7);
  EXPECT_THROW(ThinPlateBasis{centers}, QualityError);
}

TEST(AreaSamples, lie_on_the_surface_as_densely_everywhere_whatever_its_triangles) {
  const TriangleMesh box = shapes::box({0, 0, 0}, {1, 1, 3});
  const AreaSamples samples = area_samples(box, 1400);
  const Points points = samples.points(box.vertices, box.faces);
  const auto bottom = (points.row(2).array() < 1e-9).count();
  EXPECT_NEAR(static_cast<Real>(bottom), 100, 3) << "a fourteenth of the area";
  EXPECT_LT((samples.normals(box.vertices, box.faces).colwise().norm().array() - 1).abs().maxCoeff(), 1e-12);
}

}  // namespace
}  // namespace gracilis
