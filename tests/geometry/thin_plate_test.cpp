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
