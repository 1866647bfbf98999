#include <gracilis/geometry/outline_curves.hpp>
#include <gracilis/geometry/surface_region.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace gracilis {
namespace {

/// Points around a patch of a sphere, 24 of them, bent outwards and inwards, shuffled.
struct Around {
  Points in_order = Points(3, 24), shuffled;
  std::vector<Index> place;  ///< of each shuffled point in the order

  explicit Around(Real bend) {
    for (Index i = 0; i < 24; ++i) {
      const Real angle = 2 * pi * i / 24, width = 0.35 * (1 + bend * std::cos(3 * angle));
      in_order.col(i) = Vec3(std::sin(width) * std::cos(angle), std::sin(width) * std::sin(angle), std::cos(width));
    }
    place.resize(24);
    std::iota(place.begin(), place.end(), 0);
    std::shuffle(place.begin(), place.end(), std::mt19937(5));
    shuffled.resize(3, 24);
    for (Index i = 0; i < 24; ++i) shuffled.col(i) = in_order.col(place[static_cast<std::size_t>(i)]);
  }
};

constexpr int curve_count = 8;

std::string name_of(int curve) { return std::string(choices_of(OutlineCurve{})[static_cast<std::size_t>(curve)]); }

}  // namespace

TEST(OutlineCurves, every_way_finds_the_order_of_points_around_a_bent_patch) {
  const Around around(0.15);
  for (int curve = 0; curve < curve_count; ++curve) {
    const std::vector<Index> order = outline_order(static_cast<OutlineCurve>(curve), around.shuffled);
    ASSERT_EQ(order.size(), 24u) << name_of(curve);
    for (std::size_t i = 0; i < 24; ++i) {
      const Index here = around.place[static_cast<std::size_t>(order[i])];
      const Index next = around.place[static_cast<std::size_t>(order[(i + 1) % 24])];
      const Index apart = std::abs(here - next);
      EXPECT_TRUE(apart == 1 || apart == 23) << name_of(curve) << ": " << here << " to " << next;
    }
  }
}

TEST(OutlineCurves, every_way_takes_each_of_scattered_points_once) {
  std::mt19937 generator(2);
  std::uniform_real_distribution<Real> uniform(-1, 1);
  for (int trial = 0; trial < 20; ++trial) {
    Points points(3, 4 + trial);
    for (Index i = 0; i < static_cast<Index>(points.cols()); ++i)
      points.col(i) = Vec3(uniform(generator), uniform(generator), 0.1 * uniform(generator));
    for (int curve = 0; curve < curve_count; ++curve) {
      std::vector<Index> order = outline_order(static_cast<OutlineCurve>(curve), points);
      std::sort(order.begin(), order.end());
      std::vector<Index> all(static_cast<std::size_t>(points.cols()));
      std::iota(all.begin(), all.end(), 0);
      EXPECT_EQ(order, all) << name_of(curve);
    }
  }
}

TEST(OutlineCurves, the_shortest_tour_crosses_a_waist_that_angles_do_not_follow) {
  // A dumbbell: seen from its middle, both sides of a bell lie at the same angle.
  Points points(3, 28);
  for (Index i = 0; i < 14; ++i) {
    const Real angle = pi / 8 + (2 * pi - pi / 4) * i / 13;
    points.col(i) = Vec3(-1 + 0.5 * std::cos(angle), 0.5 * std::sin(angle), 0);
    points.col(14 + i) = Vec3(1 - 0.5 * std::cos(angle), -0.5 * std::sin(angle), 0);
  }
  const auto length = [](const Points& order) {
    Real sum = 0;
    for (Index i = 0; i < static_cast<Index>(order.cols()); ++i)
      sum += (order.col(i) - order.col((i + 1) % order.cols())).norm();
    return sum;
  };
  EXPECT_LE(length(ordered_outline(OutlineCurve::shortest_tour, points)), length(points) + 1e-12);
  EXPECT_GT(length(ordered_outline(OutlineCurve::angular, points)), 1.1 * length(points));
}

TEST(SurfaceRegion, the_inside_of_an_outline_on_a_sphere_is_its_cap) {
  const TriangleMesh sphere = shapes::sphere(Vec3::Zero(), 1, 5);
  const std::vector<char> inside = faces_inside(sphere, Around(0).in_order);
  const Real cap = 2 * pi * (1 - std::cos(0.35));
  EXPECT_NEAR(marked_area(sphere, inside), cap, 0.1 * cap);
  for (Index f = 0; f < sphere.face_count(); ++f)
    EXPECT_TRUE(!inside[static_cast<std::size_t>(f)] || sphere.vertices(2, sphere.faces(0, f)) > std::cos(0.45));
}

TEST(SurfaceRegion, an_outline_that_encloses_nothing_has_no_inside) {
  const TriangleMesh sphere = shapes::sphere(Vec3::Zero(), 1, 3);
  Points there_and_back(3, 4);
  there_and_back << 0, 0.4, 0.8, 0.4, 0, 0, 0, 0, 1, 0.9, 0.6, 0.9;
  EXPECT_EQ(marked_area(sphere, faces_inside(sphere, there_and_back)), 0);
  EXPECT_EQ(marked_area(sphere, faces_inside(sphere, Points(3, 0))), 0);
}

}  // namespace gracilis
