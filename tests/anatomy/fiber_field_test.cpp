#include <gracilis/anatomy/fibers/fiber_field.hpp>

#include <gracilis/anatomy/fibers/fiber_seams.hpp>
#include <gracilis/anatomy/fibers/traced_fibers.hpp>
#include <gracilis/geometry/polylines.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace gracilis {
namespace {

const TriangleMesh& block() {
  static const TriangleMesh mesh = shapes::box({-0.02, -0.02, -0.01}, {0.02, 0.02, 0.01});
  return mesh;
}

/// Nodes 2 mm apart.
const SolidGrid& grid_in_block() {
  static const SolidGrid grid(block(), SignedDistance(block()), {}, 4000);
  return grid;
}

FiberField field_of(const std::function<Vec3(const Vec3&)>& vector) {
  Points vectors(3, grid_in_block().count());
  for (Index n = 0; n < grid_in_block().count(); ++n) vectors.col(n) = vector(grid_in_block().nodes().col(n));
  return {grid_in_block(), vectors, 0.003};
}

/// Draws together towards x = 0 at 30 degrees to y, and turns around within 4 mm on either side.
FiberField bipennate() {
  return field_of([](const Vec3& p) {
    return Vec3(-std::sin(pi / 6) * std::clamp(p.x() / 0.004, -1.0, 1.0), std::cos(pi / 6), 0);
  });
}

/// As written in the header.
Real energy(const SolidGrid& grid, const std::vector<DirectionSample>& samples, Real smoothing, const Points& v) {
  Real volume = 0, total = 0, sum = 0;
  for (const Real depth : grid.depths()) volume += depth > 0 ? std::pow(grid.step(), 3) : 0;
  for (const DirectionSample& sample : samples) total += sample.weight;
  for (const SolidGrid::Edge& edge : grid.edges())  // |∇v|² of the cells around an edge, a step wide
    sum += smoothing * smoothing * grid.step() * edge.share * (v.col(edge.a) - v.col(edge.b)).squaredNorm();
  for (const DirectionSample& sample : samples)
    sum += volume * sample.weight / total * (grid.place(sample.place).mean(v) - sample.direction).squaredNorm();
  return sum;
}

std::vector<DirectionSample> scattered_samples() {
  std::vector<DirectionSample> samples;
  std::mt19937 chance(2);
  std::uniform_real_distribution<Real> share(-1, 1);
  for (Index i = 0; i < 40; ++i)
    samples.push_back({Vec3(0.018 * share(chance), 0.018 * share(chance), 0.009 * share(chance)),
                       Vec3(share(chance), 2, share(chance)).normalized(), 1.5 + share(chance), i});
  return samples;
}

}  // namespace

TEST(SmoothDirections, no_other_field_has_less_of_the_energy) {
  const std::vector<DirectionSample> samples = scattered_samples();
  const SolidGrid& grid = grid_in_block();
  const Points nothing = Points::Zero(3, grid.count());
  for (const Real smoothing : {0.002, 0.02}) {
    const Points found = smooth_directions(grid, samples, smoothing, nothing);
    const Real least = energy(grid, samples, smoothing, found);
    EXPECT_LT(least, 0.8 * energy(grid, samples, smoothing, nothing));
    std::mt19937 chance(4);
    std::uniform_real_distribution<Real> share(-1, 1);
    for (int round = 0; round < 5; ++round) {
      // A smooth change and a wild one, both ways: the energy's slope along either is nil.
      const Vec3 wave(300 * share(chance), 300 * share(chance), 300 * share(chance));
      Points change(3, grid.count());
      for (Index n = 0; n < grid.count(); ++n)
        change.col(n) = round < 3 ? Vec3(0.01 * std::cos(wave.dot(grid.nodes().col(n))) * Vec3::Ones())
                                  : Vec3(0.01 * share(chance), 0.01 * share(chance), 0.01 * share(chance));
      const Real up = energy(grid, samples, smoothing, found + change),
                 down = energy(grid, samples, smoothing, found - change);
      EXPECT_GT(up, least);
      EXPECT_GT(down, least);
      EXPECT_LT(std::abs(up - down), 0.02 * (up + down - 2 * least)) << smoothing << ' ' << round;
    }
    const Points again = smooth_directions(grid, samples, smoothing, found);
    EXPECT_LT((again - found).cwiseAbs().maxCoeff(), 1e-2);
  }
}

TEST(FiberField, is_unit_where_it_is_known_and_zero_elsewhere) {
  const FiberField field = field_of([](const Vec3& p) { return p.y() > 0.015 ? Vec3(Vec3::Zero()) : Vec3(0, 3, 4); });
  EXPECT_LT((field.direction({0.001, 0, 0}) - Vec3(0, 0.6, 0.8)).norm(), 1e-12);
  EXPECT_TRUE(field.direction({0.001, 0.019, 0}).isZero());
  EXPECT_TRUE(field.direction({1, 0, 0}).isZero());
}

TEST(FittedField, tracts_that_run_the_other_way_and_wrong_ones_do_not_turn_it) {
  std::vector<DirectionSample> samples;
  const Vec3 along = Vec3(1, 2, 0).normalized();
  std::mt19937 chance(3);
  std::uniform_real_distribution<Real> share(-1, 1);
  for (Index tract = 0; tract < 60; ++tract)
    for (int i = 0; i < 5; ++i) {
      const Vec3 place(0.018 * share(chance), 0.018 * share(chance), 0.009 * share(chance));
      const Vec3 way = tract % 6 == 5 ? Vec3(Vec3::UnitZ()) : tract % 6 == 2 ? Vec3(-along) : along;
      samples.push_back({place, way, 1, tract});
    }
  const SolidGrid grid(block(), SignedDistance(block()), {}, 600);
  const FiberField field = fitted_field(grid, samples);
  const Real way = field.direction(Vec3::Zero()).dot(along) > 0 ? 1 : -1;
  for (const Real x : {-0.015, 0.0, 0.015})
    for (const Real y : {-0.015, 0.0, 0.015})
      EXPECT_GT(way * field.direction({x, y, 0.002}).dot(along), std::cos(radians(1)));
  EXPECT_GT(field.smoothing(), 0);
}

TEST(TracedFiber, runs_along_the_field_both_ways_to_the_surface) {
  const FiberRoom room(block(), {}, 4000);
  const Vec3 along = Vec3(3, 4, 0) / 5;
  const Points line = traced_fiber(room, field_of([&](const Vec3&) { return along; }), {0.003, 0.004, 0.001});
  ASSERT_GT(line.cols(), 20);
  EXPECT_LT((line.leftCols(1) - Vec3(-0.015, -0.02, 0.001)).norm(), 1e-8) << "single precision";
  EXPECT_LT((line.rightCols(1) - Vec3(0.015, 0.02, 0.001)).norm(), 1e-8);
  for (Index i = 0; i < line.cols(); ++i) {
    EXPECT_LT((line.col(i) - Vec3(0, 0, 0.001)).cross(along).norm(), 1e-9);
    if (i == 0) continue;
    const Real step = (line.col(i) - line.col(i - 1)).dot(along);
    EXPECT_GT(step, 0);
    EXPECT_LT(step, room.grid().step() / 2 + 1e-9);
  }
}

TEST(TracedFiber, follows_an_arc_by_the_midpoint_method) {
  const FiberRoom room(block(), {}, 4000);
  const Vec3 center(-0.03, 0, 0);
  const FiberField field =
      field_of([&](const Vec3& p) { return Vec3(-(p - center).y(), (p - center).x(), 0).normalized(); });
  const Points line = traced_fiber(room, field, {0.01, 0, 0});
  ASSERT_GT(line.cols(), 20);
  for (Index i = 0; i < line.cols(); ++i) EXPECT_NEAR((line.col(i) - center).norm(), 0.04, 5e-5) << i;
}

TEST(TracedFiber, there_is_none_where_the_field_goes_round_or_nowhere) {
  const FiberRoom room(block(), {}, 4000);
  const FiberField round = field_of([](const Vec3& p) { return Vec3(-p.y(), p.x(), 0).normalized(); });
  EXPECT_EQ(traced_fiber(room, round, {0.008, 0, 0}).cols(), 0);
  EXPECT_EQ(traced_fiber(room, field_of([](const Vec3&) { return Vec3::Zero(); }), {0.008, 0, 0}).cols(), 0);
}

TEST(TracedFiber, ends_at_a_sheet_between_the_sides) {
  const TriangleMesh sheet =
      shapes::mesh_of({{-1, 0.005, -1}, {1, 0.005, -1}, {1, 0.005, 1}, {-1, 0.005, 1}}, {{0, 1, 2}, {0, 2, 3}});
  const FiberRoom room(block(), sheet, 4000);
  const Points line = traced_fiber(room, field_of([](const Vec3&) { return Vec3::UnitY(); }), {0.001, 0, 0.001});
  EXPECT_LT((line.leftCols(1) - Vec3(0.001, -0.02, 0.001)).norm(), 1e-8);
  EXPECT_LT((line.rightCols(1) - Vec3(0.001, 0.005, 0.001)).norm(), 1e-8);
}

TEST(TracedFibers, fill_a_room_evenly) {
  const FiberRoom room(block(), {}, 4000);
  const std::vector<Points> lines = evenly_traced(room, field_of([](const Vec3&) { return Vec3::UnitZ(); }), 64);
  ASSERT_EQ(lines.size(), 64u);
  std::array<int, 16> counts{};
  for (const Points& line : lines) {
    EXPECT_NEAR(polyline_length(line), 0.02, 1e-9);
    const auto column = [](Real x) { return std::clamp(static_cast<int>(std::floor((x + 0.02) / 0.01)), 0, 3); };
    ++counts[static_cast<std::size_t>(4 * column(line(0, 0)) + column(line(1, 0)))];
  }
  for (const int count : counts) EXPECT_NEAR(count, 4, 1);
}

TEST(TracedFibers, odd_numbers_are_all_there_and_one_runs_through_the_middle) {
  const FiberRoom room(block(), {}, 4000);
  const FiberField field = field_of([](const Vec3&) { return Vec3::UnitZ(); });
  EXPECT_EQ(evenly_traced(room, field, 7).size(), 7u);
  const std::vector<Points> one = evenly_traced(room, field, 1);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_LT(one[0].col(0).head<2>().norm(), 0.003);
  EXPECT_TRUE(evenly_traced(room, field_of([](const Vec3&) { return Vec3::Zero(); }), 5).empty());
}

TEST(TracedFibers, are_the_same_in_any_unit) {
  // By a power of two, so that rounding is the same.
  const Real unit = 4096;
  const TriangleMesh slab = shapes::box({-0.02, -0.02, 0}, {0.02, 0.02, 0.02});
  TriangleMesh large = slab;
  large.vertices *= unit;
  const FiberRoom room(slab, {}, 1000), large_room(large, {}, 1000);
  const auto along = [](const FiberRoom& in, Real smoothing) {
    Points way = Points::Zero(3, in.grid().count());
    way.row(2).setOnes();
    return FiberField(in.grid(), way, smoothing);
  };
  const std::vector<Points> lines = evenly_traced(room, along(room, 0.003), 13),
                            large_lines = evenly_traced(large_room, along(large_room, 0.003 * unit), 13);
  ASSERT_EQ(lines.size(), 13u);
  ASSERT_EQ(large_lines.size(), 13u);
  for (std::size_t i = 0; i < 13; ++i)
    EXPECT_LT((lines[i].leftCols(1) - large_lines[i].leftCols(1) / unit).norm(), 1e-6) << i;
}

TEST(FiberSeam, is_where_two_sides_meet_and_tells_how_they_come_to_it) {
  const FiberField field = bipennate();
  const Real reach = 0.005;
  for (const Real side : {1.0, -1.0}) {
    const auto seam = seam_at(field, {side * 0.0015, 0, 0}, 1, reach);
    ASSERT_TRUE(seam);
    EXPECT_NEAR(seam->place.x(), 0, 1e-4);
    EXPECT_NEAR(seam->across.dot(Vec3(-side, 0, 0)), 1, 1e-3);
    EXPECT_GT(seam->before.dot(Vec3(-side * 0.5, std::cos(pi / 6), 0)), std::cos(radians(1)));
  }
  EXPECT_FALSE(seam_at(field, {0.0025, 0, 0}, 1, reach)) << "not half of the turn is made";
  EXPECT_FALSE(seam_at(field, {0.012, 0, 0}, 1, reach)) << "nothing turns here";
  EXPECT_FALSE(seam_at(field, {0.0015, 0, 0}, -1, reach)) << "against the field they part";
  EXPECT_FALSE(seam_at(field, {1, 0, 0}, 1, reach)) << "outside";
}

TEST(FiberSeam, there_is_none_in_a_bundle_that_draws_together_little_or_as_much_along_as_across) {
  const auto drawn_together = [](Real angle) {
    return field_of([angle](const Vec3& p) {
      return Vec3(-std::sin(angle) * std::clamp(p.x() / 0.004, -1.0, 1.0), std::cos(angle), 0);
    });
  };
  EXPECT_TRUE(seam_at(drawn_together(radians(8)), {0.0005, 0, 0}, 1, 0.005)) << "16 degrees between them";
  EXPECT_FALSE(seam_at(drawn_together(radians(7)), {0.0005, 0, 0}, 1, 0.005)) << "14 degrees";
  const FiberField arc = field_of([](const Vec3& p) { return Vec3(-p.y() - 0.002, p.x() + 0.01, 0); });
  EXPECT_FALSE(seam_at(arc, {0.001, 0, 0}, 1, 0.005));
}

TEST(FiberSeam, a_way_ends_straight_on_it_from_where_the_turn_began) {
  const FiberSeam seam{{0, 0, 0}, -Vec3::UnitX(), Vec3(-0.6, 0.8, 0)};
  std::vector<Vec3> way = {{0.009, 0, 0}, {0.006, 0.004, 0}, {0.004, 0.007, 0}, {0.002, 0.011, 0}};
  end_at_seam(seam, 0.005, way);
  ASSERT_EQ(way.size(), 3u);
  EXPECT_LT((way[1] - Vec3(0.006, 0.004, 0)).norm(), 1e-15);
  EXPECT_LT((way[2] - Vec3(0, 0.012, 0)).norm(), 1e-15) << "6 mm across are 10 mm of way";
  std::vector<Vec3> short_way = {{0.001, 0, 0}};
  end_at_seam(seam, 0.005, short_way);
  ASSERT_EQ(short_way.size(), 2u) << "where it began stays";
  EXPECT_NEAR(short_way[1].x(), 0, 1e-15);
  std::vector<Vec3> beyond = {{-0.001, 0, 0}};
  end_at_seam(seam, 0.005, beyond);
  EXPECT_LT((beyond.back() - beyond.front()).norm(), 1e-15) << "nothing leads back";
}

}  // namespace gracilis
