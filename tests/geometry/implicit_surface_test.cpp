#include <gracilis/geometry/implicit_surface.hpp>

#include <gracilis/geometry/implicit_surface_spline.hpp>
#include <gracilis/geometry/point_triangle.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace gracilis {
namespace {

using Chance = std::mt19937;

Vec3 place_within(Chance& chance, Real reach) {
  std::uniform_real_distribution<Real> share(-reach, reach);
  return {share(chance), share(chance), share(chance)};
}

std::vector<ThickPoint> bent_points() {
  return {{{0, 0, 0}, 0.004}, {{0.02, 0.01, 0}, 0.006}, {{0.03, 0.03, 0.01}, 0.003}, {{0.01, 0.05, 0.02}, 0.005}};
}

/// Between points i and i + 1 by Hermite's polynomials; slopes are half of the difference of both neighbors, at the
/// ends the difference to the only one.
Vec3 hermite_between(const std::vector<ThickPoint>& points, std::size_t i, Real t) {
  const auto slope = [&](std::size_t k) -> Vec3 {
    if (k == 0) return points[1].point - points[0].point;
    if (k + 1 == points.size()) return points[k].point - points[k - 1].point;
    return (points[k + 1].point - points[k - 1].point) / 2;
  };
  return (1 + 2 * t) * (1 - t) * (1 - t) * points[i].point + t * (1 - t) * (1 - t) * slope(i) +
         t * t * (3 - 2 * t) * points[i + 1].point + t * t * (t - 1) * slope(i + 1);
}

ThickNet curved_net() {
  ThickNet net{3, 4, {}};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      net.points.push_back({Vec3(0.02 * column, 0.03 * row, 0.004 * column * row - 0.003 * row * row),
                            0.002 + 0.001 * ((row + 2 * column) % 3)});
  return net;
}

/// The net's points after both splines, row by row.
std::vector<std::vector<ThickPoint>> cut_net(const ThickNet& net, int pieces) {
  std::vector<std::vector<ThickPoint>> rows, columns;
  for (int row = 0; row < net.rows; ++row)
    rows.push_back(
        spline_through({net.points.begin() + row * net.columns, net.points.begin() + (row + 1) * net.columns}, pieces));
  for (std::size_t c = 0; c < rows[0].size(); ++c) {
    std::vector<ThickPoint> down;
    for (const auto& row : rows) down.push_back(row[c]);
    columns.push_back(spline_through(down, pieces));
  }
  return columns;
}

}  // namespace

TEST(ImplicitSolid, of_an_ellipsoid_is_zero_on_it_with_a_slope_of_one_and_signed) {
  const Vec3 center(0.01, 0.02, -0.01), radii(0.03, 0.02, 0.01);
  const ImplicitSolid solid = ellipsoid(center, radii);
  Chance chance(1);
  for (int i = 0; i < 50; ++i) {
    const Vec3 unit = place_within(chance, 1).normalized(), on = center + radii.cwiseProduct(unit);
    const Vec3 outwards = unit.cwiseQuotient(radii).normalized();
    EXPECT_NEAR(solid.distance(on), 0, 1e-15);
    EXPECT_NEAR((solid.distance(on + 1e-6 * outwards) - solid.distance(on - 1e-6 * outwards)) / 2e-6, 1, 1e-3);
    EXPECT_TRUE(solid.bounds.contains(on + 1e-9 * (center - on)));
    EXPECT_LT(solid.distance(center + 0.9 * radii.cwiseProduct(unit)), 0);
  }
  EXPECT_EQ(solid.distance(center), -0.01) << "its middle, where no direction is told";
  EXPECT_LT((solid.bounds.max() - center - radii).norm(), 1e-15);
  EXPECT_LT((solid.bounds.min() - center + radii).norm(), 1e-15);
  EXPECT_NEAR(solid.distance(center + Vec3(0.05, 0, 0)), 0.02, 1e-15) << "far away that to its box";
  EXPECT_NEAR(solid.distance(center + Vec3(0, 0, 0.024)), 0.014, 1e-15) << "along an axis its own";
}

TEST(ImplicitSolid, a_half_space_is_what_lies_behind_its_plane) {
  const ImplicitSolid half = half_space({0.01, 0, 0}, {3, 4, 0}, {Vec3::Constant(-1), Vec3::Constant(1)});
  EXPECT_NEAR(half.distance({0.01, 0, 5}), 0, 1e-15);
  EXPECT_NEAR(half.distance({0.04, 0.04, 0}), 0.05, 1e-15);
  EXPECT_NEAR(half.distance({-0.02, -0.04, 0}), -0.05, 1e-15);
  EXPECT_EQ(half.bounds.max(), Vec3::Ones());
}

TEST(ImplicitSolid, of_a_curve_is_the_least_distance_to_its_balls) {
  const ImplicitSolid curve = thick_curve(bent_points());
  const std::vector<ThickPoint> chain = spline_through(bent_points(), 6);
  Chance chance(2);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = Vec3(0.015, 0.025, 0.01) + place_within(chance, 0.03);
    if (curve.bounds.exteriorDistance(p) > far_distance) continue;
    Real least = std::numeric_limits<Real>::infinity();
    for (std::size_t k = 0; k + 1 < chain.size(); ++k)
      for (int step = 0; step <= 40; ++step) {
        const Real t = step / 40.0;
        least = std::min(least, (p - (1 - t) * chain[k].point - t * chain[k + 1].point).norm() -
                                    (1 - t) * chain[k].radius - t * chain[k + 1].radius);
      }
    // The nearest point of the middle line stands in for the nearest ball, which differs by the radii's slope.
    EXPECT_NEAR(curve.distance(p), least, 3e-4) << p.transpose();
  }
  const ImplicitSolid point = thick_curve({{{0.1, 0, 0}, 0.02}});
  EXPECT_NEAR(point.distance({0.1, 0.025, 0}), 0.005, 1e-15);
  const ImplicitSolid twice = thick_curve({{{0.1, 0, 0}, 0.02}, {{0.1, 0, 0}, 0.02}});
  EXPECT_NEAR(twice.distance({0.1, 0.025, 0}), 0.005, 1e-15) << "a piece without length";
}

TEST(ImplicitSolid, its_answer_far_away_is_the_distance_to_its_box) {
  const ImplicitSolid curve = thick_curve({{{0, 0, 0}, 0.01}, {{0.1, 0, 0}, 0.01}});
  EXPECT_LT((curve.bounds.min() + Vec3(0.01, 0.01, 0.01)).norm(), 1e-12);
  EXPECT_LT((curve.bounds.max() - Vec3(0.11, 0.01, 0.01)).norm(), 1e-12);
  const Vec3 corner(0.11, 0.01, 0.01), aslant = Vec3(1, 1, 1).normalized();
  EXPECT_NEAR(curve.distance(corner + 0.0151 * aslant), 0.0151, 1e-12);
  EXPECT_NEAR(curve.distance(corner + 0.0149 * aslant), (Vec3(0.01, 0.01, 0.01) + 0.0149 * aslant).norm() - 0.01,
              1e-12);
}

TEST(ImplicitSolid, a_union_is_the_smooth_minimum_wherever_it_is_near_and_its_box_holds_the_fillets) {
  const ImplicitSolid one = ball({0, 0, 0}, 0.02), other = ball({0.03, 0, 0}, 0.015), far = ball({0.2, 0, 0}, 0.01);
  const Real blend = 0.01;
  const ImplicitSolid whole = smooth_union({one, other, far}, blend);
  Chance chance(3);
  for (int i = 0; i < 300; ++i) {
    const Vec3 p = Vec3(0.015, 0, 0) + place_within(chance, 0.04);
    const Real away = whole.bounds.exteriorDistance(p);
    const Real near = smooth_minimum(smooth_minimum(one.distance(p), other.distance(p), blend), far.distance(p), blend);
    EXPECT_EQ(whole.distance(p), away > far_distance ? away : near);
  }
  EXPECT_LT((whole.bounds.min() - Vec3(-0.025, -0.025, -0.025)).norm(), 1e-12);
  EXPECT_LT((whole.bounds.max() - Vec3(0.215, 0.025, 0.025)).norm(), 1e-12);
}

TEST(ImplicitSolid, what_is_in_both_is_an_intersection_with_a_rounded_edge) {
  const ImplicitSolid one = ball({0, 0, 0}, 0.02), other = ball({0.02, 0, 0}, 0.02);
  const ImplicitSolid lens = smooth_intersection(one, other, 0.004);
  Chance chance(4);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = Vec3(0.01, 0, 0) + place_within(chance, 0.02);
    const Real sharp = std::max(one.distance(p), other.distance(p));
    EXPECT_GE(lens.distance(p), sharp);
    EXPECT_LE(lens.distance(p), sharp + 0.001 + 1e-15) << "a quarter of the blend";
    if (std::abs(one.distance(p) - other.distance(p)) > 0.004) {
      EXPECT_EQ(lens.distance(p), sharp);
    }
  }
  EXPECT_LT((lens.bounds.min() - Vec3(0, -0.02, -0.02)).norm(), 1e-12);
  EXPECT_LT((lens.bounds.max() - Vec3(0.02, 0.02, 0.02)).norm(), 1e-12);
}

TEST(ImplicitSolid, a_difference_is_rounded_at_its_edge_alone) {
  const ImplicitSolid solid = ball({0, 0, 0}, 0.02), removed = ball({0.02, 0, 0}, 0.01);
  const ImplicitSolid rest = smooth_difference(solid, removed, 0.004);
  Chance chance(5);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = place_within(chance, 0.03);
    EXPECT_EQ(rest.distance(p), smooth_maximum(solid.distance(p), -removed.distance(p), 0.004));
  }
}

TEST(SmoothMinimum, meets_the_smaller_with_its_slope_where_the_blend_begins_and_is_symmetric) {
  const Real blend = 0.2, step = 1e-6;
  for (const Real a : {-0.3, 0.0, 0.4}) {
    EXPECT_NEAR(smooth_minimum(a, a + blend, blend), a, 1e-15);
    EXPECT_NEAR(smooth_minimum(a, a + blend - step, blend), a, 1e-11);
    for (const Real b : {a - 0.15, a + 0.02, a + 0.19, a + 0.3}) {
      EXPECT_EQ(smooth_minimum(a, b, blend), smooth_minimum(b, a, blend));
      EXPECT_LE(smooth_minimum(a, b, blend), std::min(a, b));
      EXPECT_GE(smooth_minimum(a, b, blend), std::min(a, b) - blend / 4);
      const Real slope_sum = (smooth_minimum(a + step, b + step, blend) - smooth_minimum(a, b, blend)) / step;
      EXPECT_NEAR(slope_sum, 1, 1e-6) << "as far as both are moved";
    }
  }
}

TEST(Spline, is_that_of_catmull_and_rom_between_all_points) {
  const std::vector<ThickPoint> points = bent_points();
  for (const int pieces : {1, 5}) {
    const std::vector<ThickPoint> cut = spline_through(points, pieces);
    ASSERT_EQ(cut.size(), 3u * static_cast<std::size_t>(pieces) + 1);
    for (std::size_t k = 0; k + 1 < cut.size(); ++k) {
      const std::size_t i = k / static_cast<std::size_t>(pieces);
      const Real t = static_cast<Real>(k % static_cast<std::size_t>(pieces)) / pieces;
      EXPECT_LT((cut[k].point - hermite_between(points, i, t)).norm(), 1e-15) << k;
    }
    EXPECT_EQ(cut.back().point, points.back().point);
    EXPECT_EQ(cut.back().radius, points.back().radius);
  }
  EXPECT_EQ(spline_through({points[1]}, 3).size(), 1u);
}

TEST(Spline, radii_follow_it_but_stay_above_half_a_millimeter) {
  const std::vector<ThickPoint> points = {
      {{0, 0, 0}, 0.01}, {{1, 0, 0}, 0.0006}, {{2, 0, 0}, 0.0006}, {{3, 0, 0}, 0.01}};
  const std::vector<ThickPoint> cut = spline_through(points, 4);
  // Half way between the thin ones the spline is at (-1, 9, 9, -1) / 16 of the four, below zero.
  EXPECT_EQ(cut[6].radius, 0.0005);
  EXPECT_NEAR(cut[2].radius, (9 * 0.01 + 9 * 0.0006 - 0.0006 - (2 * 0.01 - 0.0006)) / 16, 1e-15);
}

TEST(ThickSheet, no_triangle_of_the_cut_net_is_nearer) {
  const ThickNet net = curved_net();
  const int pieces = 4;
  const ThickSheet sheet(net, pieces);
  const auto columns = cut_net(net, pieces);
  Eigen::AlignedBox3d box;
  for (const auto& column : columns)
    for (const ThickPoint& p : column) {
      box.extend(Vec3(p.point + Vec3::Constant(p.radius)));
      box.extend(Vec3(p.point - Vec3::Constant(p.radius)));
    }
  EXPECT_LT((sheet.bounds().min() - box.min()).norm(), 1e-15);
  EXPECT_LT((sheet.bounds().max() - box.max()).norm(), 1e-15);
  Chance chance(6);
  const ImplicitSolid solid = thick_sheet(net);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = Vec3(0.03, 0.03, 0.005) + place_within(chance, 0.05);
    Real least = std::numeric_limits<Real>::infinity(), along = 0, across = 0;
    for (std::size_t c = 0; c + 1 < columns.size(); ++c)
      for (std::size_t r = 0; r + 1 < columns[0].size(); ++r)
        for (const bool second : {false, true}) {
          const std::array<std::array<std::size_t, 2>, 3> at = {
              {{second ? r + 1 : r, c}, {r, c + 1}, {r + 1, second ? c + 1 : c}}};
          std::array<ThickPoint, 3> x;
          for (std::size_t k = 0; k < 3; ++k) x[k] = columns[at[k][1]][at[k][0]];
          const Vec3 l = nearest_barycentric(p, x[0].point, x[1].point, x[2].point);
          const Vec3 on = l[0] * x[0].point + l[1] * x[1].point + l[2] * x[2].point;
          const Real distance = (p - on).norm() - l[0] * x[0].radius - l[1] * x[1].radius - l[2] * x[2].radius;
          if (distance >= least) continue;
          least = distance, along = across = 0;
          for (std::size_t k = 0; k < 3; ++k) {
            along += l[static_cast<Index>(k)] * static_cast<Real>(at[k][0]) / (net.rows - 1) / pieces;
            across += l[static_cast<Index>(k)] * static_cast<Real>(at[k][1]) / (net.columns - 1) / pieces;
          }
        }
    const ThickSheet::Nearest found = sheet.nearest(p);
    EXPECT_NEAR(found.distance, least, 1e-12);
    EXPECT_NEAR(found.along, along, 1e-6);
    EXPECT_NEAR(found.across, across, 1e-6);
    const Real away = box.exteriorDistance(p);
    EXPECT_EQ(solid.distance(p), away > far_distance ? away : found.distance);
  }
}

}  // namespace gracilis
