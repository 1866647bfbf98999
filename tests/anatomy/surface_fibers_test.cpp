#include <gracilis/anatomy/fibers/surface_fibers.hpp>

#include <gracilis/anatomy/fibers/inner_fibers.hpp>
#include <gracilis/anatomy/fibers/superficial_fibers.hpp>
#include <gracilis/geometry/topology.hpp>

#include "anatomy/muscles_for_tests.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace gracilis {
namespace {

std::set<std::pair<Index, Index>> edges_of(const Muscle& muscle) {
  std::set<std::pair<Index, Index>> edges;
  for (const MeshEdge& edge : build_topology(muscle.surface.faces, muscle.surface.vertex_count()).edges)
    edges.insert({edge.a, edge.b});
  return edges;
}

void expect_paths_along_edges(const Muscle& muscle, const SurfaceFibers& found) {
  const auto edges = edges_of(muscle);
  for (const std::vector<Index>& path : found.paths) {
    ASSERT_FALSE(path.empty());
    for (std::size_t i = 1; i < path.size(); ++i) EXPECT_TRUE(edges.contains(std::minmax(path[i - 1], path[i])));
  }
  for (const FiberSegment& segment : found.segments) {
    EXPECT_TRUE(edges.contains({segment.a, segment.b}));
    EXPECT_NEAR(segment.rest_length,
                (muscle.surface.vertices.col(segment.a) - muscle.surface.vertices.col(segment.b)).norm(), 1e-15);
    EXPECT_GE(segment.fibers, 1);
  }
}

/// Within 60 degrees of the tube's axis.
bool along_axis(const Muscle& muscle, const FiberSegment& segment) {
  const Vec3 edge = muscle.surface.vertices.col(segment.b) - muscle.surface.vertices.col(segment.a);
  return std::abs(edge.z()) >= 0.49 * edge.norm();
}

}  // namespace

TEST(SurfaceFibers, of_a_tube_run_along_it_from_end_to_end) {
  const Muscle muscle = tube_muscle();
  const Polylines fibers = inner_fibers(muscle);
  const SurfaceFibers found = surface_fibers(muscle, fibers);
  ASSERT_EQ(found.paths.size(), 100u);
  expect_paths_along_edges(muscle, found);
  for (const std::vector<Index>& path : found.paths) {
    EXPECT_NEAR(muscle.surface.vertices(2, path.front()), 0, 1e-9);
    EXPECT_NEAR(muscle.surface.vertices(2, path.back()), 0.2, 1e-9);
  }
  for (const FiberSegment& segment : found.segments) EXPECT_TRUE(along_axis(muscle, segment));
  EXPECT_GT(found.coverage, 0.6);
}

TEST(SurfaceFibers, as_published_reject_what_runs_across) {
  const Muscle muscle = tube_muscle();
  const Polylines fibers = inner_fibers(muscle);
  const SurfaceFibers published = surface_fibers(muscle, fibers, SurfacePaths::nearest_joined);
  const SurfaceFibers better = surface_fibers(muscle, fibers);
  expect_paths_along_edges(muscle, published);
  for (const FiberSegment& segment : published.segments) EXPECT_TRUE(along_axis(muscle, segment));
  const auto share = [](const SurfaceFibers& found) {
    return static_cast<Real>(found.rejected) / static_cast<Real>(found.segments.size() + found.rejected);
  };
  EXPECT_LE(share(better), share(published));
}

TEST(SurfaceFibers, told_not_to_reject_keep_every_edge_as_often_as_fibers_run_over_it) {
  const Muscle muscle = tube_muscle();
  const Polylines fibers = inner_fibers(muscle);
  const SurfaceFibers some = surface_fibers(muscle, fibers, SurfacePaths::nearest_joined);
  const SurfaceFibers all = surface_fibers(muscle, fibers, SurfacePaths::nearest_joined, false);
  ASSERT_GT(some.rejected, 0);
  EXPECT_EQ(all.rejected, 0);
  EXPECT_EQ(static_cast<Index>(all.segments.size()), static_cast<Index>(some.segments.size()) + some.rejected);
  Index steps = 0, counted = 0;
  for (const std::vector<Index>& path : all.paths) steps += static_cast<Index>(path.size()) - 1;
  for (const FiberSegment& segment : all.segments) counted += segment.fibers;
  EXPECT_EQ(counted, steps) << "each as often as a fiber runs over it";
}

TEST(SurfaceFibers, drawn_by_hand_join_the_nearest_vertices) {
  const Muscle muscle = tube_muscle();
  Points line(3, 3);
  line << 0.0151, 0.0151, 0.0151, 0, 0, 0, 0.02, 0.1, 0.18;
  const SurfaceFibers found = surface_fibers_from_lines(muscle, join({line}));
  ASSERT_EQ(found.paths.size(), 1u);
  expect_paths_along_edges(muscle, found);
  EXPECT_EQ(found.rejected, 0);
  Real length = 0;
  for (const FiberSegment& segment : found.segments) length += segment.rest_length;
  EXPECT_NEAR(length, 0.16, 1e-9) << "a straight line of edges";
}

TEST(SurfaceFibers, stay_near_a_fiber_of_two_pieces_that_goes_around_the_muscle) {
  const Muscle muscle = tube_muscle();
  Points bent(3, 3);  // from the front to the side and back
  bent << 0.015, 0, 0.015, 0, 0.015, 0, 0, 0.1, 0.2;
  const SurfaceFibers found = surface_fibers(muscle, join({bent}));
  ASSERT_EQ(found.paths.size(), 1u);
  Real least_x = 1;
  for (const Index v : found.paths[0]) least_x = std::min(least_x, muscle.surface.vertices(0, v));
  EXPECT_LT(least_x, 0.005) << "at the side x is 0; a straight way stays at 0.015";
}

TEST(SurfaceFibers, run_as_the_nearest_fibers_do) {
  Points up(3, 3), across(3, 3);
  up << 0, 0, 0, 0, 0, 0, 0, 0.01, 0.02;
  across << 0.5, 0.51, 0.52, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5;
  Points places(3, 2);
  places << 0.001, 0.51, 0, 0.501, 0.01, 0.5;
  const Points directions = directions_of_fibers(join({up, across}), places);
  EXPECT_GT(directions(2, 0), 0.999);
  EXPECT_GT(directions(0, 1), 0.999);
  Points corner(3, 3);
  corner << 0, 0.01, 0.01, 0, 0, 0.01, 0, 0, 0;
  places << 0.005, 0.01, 0, 0.005, 0, 0;  // the middles of its two pieces
  const Points around = directions_of_fibers(join({corner}), places);
  EXPECT_GT(around(0, 0), 0.999);
  EXPECT_GT(around(1, 1), 0.999);
}

TEST(SurfaceFibers, are_the_same_wherever_the_muscle_lies) {
  const Muscle muscle = bent_muscle();
  const Polylines fibers = inner_fibers(muscle);
  const Vec3 shift(0.5, -0.25, -0.5);
  Muscle moved = muscle;
  moved.surface.vertices.colwise() += shift;
  Polylines moved_fibers = fibers;
  moved_fibers.points.colwise() += shift;
  for (const SurfacePaths paths : {SurfacePaths::along_fibers, SurfacePaths::nearest_joined}) {
    const SurfaceFibers here = surface_fibers(muscle, fibers, paths),
                        there = surface_fibers(moved, moved_fibers, paths);
    EXPECT_NEAR(here.rejected, there.rejected, 2) << "as rounding decides between ways of one length";
    EXPECT_NEAR(static_cast<Real>(here.segments.size()), static_cast<Real>(there.segments.size()), 20);
    EXPECT_NEAR(here.coverage, there.coverage, 0.01);
  }
}

TEST(SurfaceFibers, reach_what_lies_on_a_segment_or_beside_one) {
  // One line along the tube's front covers its ring of vertices and those on either side: 3 columns of 40.
  const Muscle muscle = tube_muscle();
  Points line(3, 2);
  line << 0.015, 0.015, 0, 0, 0, 0.2;
  const SurfaceFibers found = surface_fibers_from_lines(muscle, join({line}));
  EXPECT_EQ(found.segments.size(), 80u);
  EXPECT_NEAR(found.coverage, 3.0 / 40, 1e-3);
  // From a fifth to two fifths of its way: 16 segments, and the rings beside their ends, of which one way alone leads.
  line.row(2) << 0.04, 0.08;
  const SurfaceFibers part = surface_fibers_from_lines(muscle, join({line, line}));
  ASSERT_EQ(part.segments.size(), 16u);
  for (const FiberSegment& segment : part.segments) EXPECT_EQ(segment.fibers, 2);
  EXPECT_NEAR(part.coverage, (17.0 * 3 + 4) / (40 * 79), 1e-3);
  const Polylines lines = segment_lines(part, muscle.surface.vertices);
  ASSERT_EQ(lines.count(), 16);
  for (Index i = 0; i < 16; ++i) EXPECT_NEAR(polyline_length(lines.line(i)), 0.0025, 1e-12);
}

TEST(SurfaceFibers, a_muscle_contracts_along_lines_drawn_by_hand_or_along_its_fibers_in_as_many_pieces_as_it_says) {
  Muscle muscle = tube_muscle();
  muscle.contraction.segments = 7;
  Muscle finer = muscle;
  finer.fibers.segments = 7;
  const SurfaceFibers along = contracting_fibers(muscle);
  EXPECT_EQ(
      along.paths,
      surface_fibers(muscle, inner_fibers(finer), muscle.contraction.paths, muscle.contraction.reject_across).paths);
  Points line(3, 2);
  line << 0.015, 0.015, 0, 0, 0, 0.2;
  muscle.given_surface_fibers = join({line});
  EXPECT_EQ(contracting_fibers(muscle).paths.size(), 1u);
}

TEST(SurfaceFibers, there_are_none_without_fibers) {
  EXPECT_TRUE(surface_fibers(tube_muscle(), Polylines()).segments.empty());
}

TEST(FilledBetween, straight_lines_along_a_tube_gives_straight_fibers) {
  const Muscle muscle = tube_muscle();
  std::vector<Points> lines;
  for (const Real angle : {0.3, 0.9, 1.5, 2.1}) {
    Points line(3, 4);
    for (Index i = 0; i < 4; ++i) line.col(i) = Vec3(0.015 * std::cos(angle), 0.015 * std::sin(angle), 0.01 + 0.06 * i);
    lines.push_back(line);
  }
  const Polylines fibers = filled_between(muscle, join(lines));
  ASSERT_EQ(fibers.count(), 100);
  for (Index i = 0; i < fibers.count(); ++i) EXPECT_NEAR(polyline_length(fibers.line(i)), 0.2, 0.008);
}

TEST(FilledBetween, straight_lines_leave_the_fibers_of_the_parallel_template_where_they_are) {
  // Places along a straight line are its mean place: between such lines nothing moves.
  const Muscle muscle = tube_muscle();
  std::vector<Points> lines;
  for (const Real angle : {0.3, 0.9, 1.5, 2.1, 2.7}) {
    Points line(3, 4);
    for (Index i = 0; i < 4; ++i) line.col(i) = Vec3(0.015 * std::cos(angle), 0.015 * std::sin(angle), 0.01 + 0.06 * i);
    lines.push_back(line);
  }
  const Polylines filled = filled_between(muscle, join(lines)), parallel = inner_fibers(muscle);
  ASSERT_EQ(filled.points.cols(), parallel.points.cols());
  Real sum = 0;
  for (Index i = 0; i < filled.points.cols(); ++i) sum += (filled.points.col(i) - parallel.points.col(i)).norm();
  EXPECT_LT(sum / static_cast<Real>(filled.points.cols()), 3e-4) << "fibers are 3 mm apart";
}

TEST(FilledBetween, lines_that_run_askew_gives_fibers_that_do) {
  const Muscle muscle = tube_muscle();
  const auto turn_of = [&](Real twist) {
    std::vector<Points> lines;
    for (const Real angle : {0.8, 1.2, 1.6, 2.0, 2.4}) {
      Points line(3, 9);
      for (Index i = 0; i < 9; ++i) {
        const Real z = 0.02 + 0.02 * i, at = angle + twist * (z - 0.1);
        line.col(i) = Vec3(0.015 * std::cos(at), 0.015 * std::sin(at), z);
      }
      lines.push_back(line);
    }
    const Polylines fibers = filled_between(muscle, join(lines));
    // How far fibers go sideways between a quarter and three quarters of their way.
    Vec3 sideways = Vec3::Zero();
    for (Index i = 0; i < fibers.count(); ++i)
      sideways += (fibers.line(i).col(11) - fibers.line(i).col(4)) / fibers.count();
    return sideways.x();
  };
  const Real one_way = turn_of(5), other_way = turn_of(-5);
  EXPECT_LT(one_way, other_way - 0.001);
}

TEST(FilledBetween, fibers_swing_with_lines_that_swing) {
  // To one side until a quarter of their way, to the other until three quarters.
  const Muscle muscle = tube_muscle();
  const auto swing_of = [&](Real swing) {
    std::vector<Points> lines;
    for (const Real angle : {1.0, 1.3, pi / 2, 1.8, 2.1}) {
      Points line(3, 33);
      for (Index i = 0; i < 33; ++i) {
        const Real z = 0.01 + 0.18 * i / 32, at = angle + swing * std::sin(2 * pi * z / 0.2);
        line.col(i) = Vec3(0.015 * std::cos(at), 0.015 * std::sin(at), z);
      }
      lines.push_back(line);
    }
    const Polylines fibers = filled_between(muscle, join(lines));
    // Of those near the front, from a quarter to three quarters of their way.
    Vec3 sum = Vec3::Zero();
    Index count = 0;
    for (Index i = 0; i < fibers.count(); ++i) {
      const Points line = resampled(fibers.line(i), 4);
      if (line(1, 2) > 0.006) sum += line.col(3) - line.col(1), ++count;
    }
    EXPECT_GT(count, 5);
    return sum.x() / count;
  };
  // Lines themselves go by 2 · 15 mm · sin(0.3), 9 mm; fibers at some depth, and smoothed, by somewhat less.
  EXPECT_GT(swing_of(0.3), 0.004);
  EXPECT_LT(swing_of(0.3), 0.0095);
  EXPECT_LT(swing_of(-0.3), -0.004);
}

TEST(FilledBetween, no_usable_line_gives_the_parallel_template) {
  const Muscle muscle = tube_muscle();
  EXPECT_TRUE(filled_between(muscle, Polylines()).points == inner_fibers(muscle).points);
}

}  // namespace gracilis
