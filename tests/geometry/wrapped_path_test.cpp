#include <gracilis/geometry/wrapped_path.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace gracilis {
namespace {

PathStop stop_at(const Vec3& place, int given, Index body = 0) {
  PathStop stop;
  stop.body = body;
  stop.place = place;
  stop.given = given;
  return stop;
}

/// About z through a place, between these of a path's points.
PlacedWrap cylinder_at(const Vec3& center, Real radius, int first, int last) {
  PlacedWrap wrap;
  wrap.surface.radius = radius;
  wrap.surface.length = 1;
  wrap.frame.translation() = center;
  wrap.body = 7;
  wrap.first_point = first;
  wrap.last_point = last;
  return wrap;
}

/// From (-d, h) to (d, h) around a circle about the origin.
Real length_around(Real d, Real h, Real radius) {
  const Real away = std::hypot(d, h), turn = pi - 2 * std::atan2(h, d) - 2 * std::acos(radius / away);
  return 2 * std::sqrt(away * away - radius * radius) + radius * turn;
}

std::vector<PathStop> solved(const std::vector<PlacedWrap>& wraps, std::vector<PathStop> stops) {
  solve_path(wraps, stops);
  return stops;
}

}  // namespace

TEST(WrappedPath, around_a_cylinder_is_two_tangents_and_an_arc) {
  const Vec3 center(0.3, 0.2, 0.1);
  const std::vector<PlacedWrap> wraps = {cylinder_at(center, 0.02, 0, 1)};
  const std::vector<PathStop> path =
      solved(wraps, {stop_at(center + Vec3(-0.1, 0.005, 0), 0, 3), stop_at(center + Vec3(0.1, 0.005, 0), 1, 4)});
  ASSERT_EQ(path.size(), 4u);
  EXPECT_NEAR(length_of(path), length_around(0.1, 0.005, 0.02), 1e-12);
  for (const std::size_t i : {1u, 2u}) {
    EXPECT_EQ(path[i].wrap, 0);
    EXPECT_EQ(path[i].given, -1);
    EXPECT_EQ(path[i].body, 7);
    EXPECT_NEAR((path[i].place - center).head<2>().norm(), 0.02, 1e-12);
  }
  // As a line it is as long, but for the corners that five degrees cut off.
  std::vector<Index> bodies;
  const Points line = line_through(path, wraps, radians(5), &bodies);
  ASSERT_EQ(line.cols(), static_cast<Index>(bodies.size()));
  EXPECT_EQ(bodies.front(), 3);
  EXPECT_EQ(bodies[1], 7);
  EXPECT_EQ(bodies.back(), 4);
  Real length = 0;
  for (Index i = 1; i < line.cols(); ++i) length += (line.col(i) - line.col(i - 1)).norm();
  EXPECT_LT(length, length_of(path));
  EXPECT_NEAR(length, length_of(path), 5e-5);
  for (Index i = 1; i + 1 < line.cols(); ++i) EXPECT_NEAR((line.col(i) - center).head<2>().norm(), 0.02, 1e-12);
  for (Index i = 2; i + 1 < line.cols(); ++i)
    EXPECT_LE((line.col(i) - line.col(i - 1)).norm(), 0.04 * std::sin(radians(2.5)) + 1e-12);
}

TEST(WrappedPath, a_sphere_is_passed_on_the_side_that_it_is_held_on_whichever_side_the_line_runs_on_and_whichever_way) {
  for (const Real height : {0.005, -0.005})
    for (const int side : {1, -1})
      for (const Real way : {1.0, -1.0}) {
        PlacedWrap wrap;
        wrap.surface.kind = WrapSurface::Kind::sphere;
        wrap.surface.radius = 0.02;
        wrap.surface.side_axis = 1;
        wrap.surface.side_sign = side;
        wrap.last_point = 1;
        const std::vector<PathStop> path =
            solved({wrap}, {stop_at({-0.1 * way, height, 0}, 0), stop_at({0.1 * way, height, 0}, 1)});
        ASSERT_EQ(path.size(), 4u);
        EXPECT_NEAR(length_of(path), length_around(0.1, side * height, 0.02), 1e-12) << height << side << way;
        EXPECT_NEAR(path[2].around.way.at(0.5).y(), side * 0.02, 1e-12);
      }
}

TEST(WrappedPath, beside_or_out_of_the_range_of_a_surface_is_straight) {
  const std::vector<PathStop> across = {stop_at({-0.1, 0.005, 0}, 0), stop_at({0.1, 0.005, 0}, 2)};
  EXPECT_EQ(solved({cylinder_at({0, 0.05, 0}, 0.02, 0, 2)}, across).size(), 2u);
  EXPECT_EQ(solved({cylinder_at(Vec3::Zero(), 0.02, 0, 2)}, across).size(), 4u);
  EXPECT_EQ(solved({cylinder_at(Vec3::Zero(), 0.02, 0, 1)}, across).size(), 2u)
      << "the last point of its range is not there";
  EXPECT_EQ(solved({cylinder_at(Vec3::Zero(), 0.02, 1, 2)}, across).size(), 2u) << "nor the first";
  EXPECT_EQ(solved({cylinder_at(Vec3::Zero(), 0.02, 0, 5)}, across).size(), 4u);
  EXPECT_NEAR(length_of(across), 0.2, 1e-15);
}

TEST(WrappedPath, of_several_parts_the_one_that_is_cut_goes_around) {
  const Vec3 before(-0.2, 0.1, 0), a(-0.1, 0.005, 0), b(0.1, 0.005, 0), behind(0.2, 0.1, 0);
  const std::vector<PathStop> path = solved({cylinder_at(Vec3::Zero(), 0.02, 0, 3)},
                                            {stop_at(before, 0), stop_at(a, 1), stop_at(b, 2), stop_at(behind, 3)});
  ASSERT_EQ(path.size(), 6u);
  const int given[] = {0, 1, -1, -1, 2, 3};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(path[i].given, given[i]) << i;
  EXPECT_NEAR(length_of(path), (before - a).norm() + length_around(0.1, 0.005, 0.02) + (behind - b).norm(), 1e-12);
}

TEST(WrappedPath, over_two_cylinders_is_a_taut_belt_in_whichever_order_they_are_listed) {
  const Real radius = 0.02, apart = 0.1;
  const PlacedWrap first = cylinder_at({0, 0, 0}, radius, 0, 1), second = cylinder_at({apart, 0, 0}, radius, 0, 1);
  const std::vector<PathStop> ends = {stop_at({-0.08, 0.002, 0}, 0), stop_at({apart + 0.08, 0.002, 0}, 1)};
  // Halves of the way around one cylinder between points that mirror each other, and the straight part over both.
  const Real belt = length_around(0.08, 0.002, radius) + apart;
  for (const auto& wraps : {std::vector{first, second}, std::vector{second, first}}) {
    const std::vector<PathStop> path = solved(wraps, ends);
    ASSERT_EQ(path.size(), 6u);
    EXPECT_NEAR(length_of(path), belt, 5e-4) << "as near as the rounds go";
    EXPECT_GT(path[2].place.y(), 0.019);
    EXPECT_LT(path[1].place.x(), path[2].place.x());
    EXPECT_LT(path[3].place.x(), path[4].place.x());
  }
}

TEST(WrappedPath, solved_again_is_what_it_was) {
  const std::vector<PlacedWrap> wraps = {cylinder_at(Vec3::Zero(), 0.02, 0, 1)};
  const std::vector<PathStop> once = solved(wraps, {stop_at({-0.1, 0.005, 0}, 0), stop_at({0.1, 0.005, 0}, 1)});
  const std::vector<PathStop> twice = solved(wraps, once);
  ASSERT_EQ(twice.size(), once.size());
  for (std::size_t i = 0; i < once.size(); ++i) EXPECT_EQ(twice[i].place, once[i].place);
}

TEST(WrappedPath, neighbors_that_coincide_become_one_point_of_its_line) {
  const std::vector<PathStop> stops = {stop_at({0, 0, 0}, 0, 1), stop_at({0, 0, 5e-10}, 1, 2),
                                       stop_at({0, 0, 1}, 2, 3)};
  std::vector<Index> bodies;
  EXPECT_EQ(line_through(stops, {}, 1, &bodies), (Points(3, 2) << 0, 0, 0, 0, 0, 1).finished());
  EXPECT_EQ(bodies, (std::vector<Index>{1, 3}));
}

}  // namespace gracilis
