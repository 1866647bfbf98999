#include <gracilis/methods/mass_spring/layout.hpp>
#include <gracilis/methods/mass_spring/particles.hpp>

#include <scenes_for_tests.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

namespace gracilis::mass_spring {
namespace {

/// Straight fibers along z on a square lattice of 10 mm, shuffled, with particles every 10 mm.
Polylines lattice_of_fibers(int side, int along) {
  std::vector<Points> lines;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      Points line(3, along);
      for (int k = 0; k < along; ++k) line.col(k) = 0.01 * Vec3(1.3 * i, j, k);  // wider along x
      lines.push_back(line);
    }
  std::shuffle(lines.begin(), lines.end(), std::mt19937(5));
  return join(lines);
}

std::map<Index, int> neighbor_counts(const SpringPairs& pairs) {
  std::map<Index, int> counts;
  for (const auto& [a, b] : pairs) {
    ++counts[a];
    ++counts[b];
  }
  return counts;
}

}  // namespace

TEST(MassSpringLayout, particles_lie_at_equal_arc_length_behind_a_first_step_of_their_own) {
  Points line(3, 3);
  line << 0, 3, 3, 0, 0, 1, 0, 0, 0;  // 4 m long, with a corner
  const Points found = sampled_along(line, 6, 0.5);
  const std::vector<Real> distances = distances_along(line);
  EXPECT_EQ(distances.back(), 4);
  const Points expected = points_along(line, {0, 0.5, 1.5, 2.5, 3.5, 4});
  EXPECT_LT((found - expected).norm(), 1e-12);
}

TEST(MassSpringLayout, first_steps_are_random_between_nothing_and_a_whole_step_and_follow_the_seed) {
  const Polylines fibers = lattice_of_fibers(10, 12);
  const Polylines particles = particles_along(fibers, 12, 7);
  const Real step = 0.11 / 10;
  Real least = 1, most = 0;
  for (Index f = 0; f < particles.count(); ++f) {
    ASSERT_EQ(particles.size(f), 12);
    const Points line = particles.line(f);
    EXPECT_LT((line.col(0) - fibers.line(f).col(0)).norm(), 1e-15) << "the first stays where the fiber begins";
    EXPECT_LT((line.col(11) - fibers.line(f).col(11)).norm(), 1e-15) << "the last where it ends";
    const Real first = (line.col(1) - line.col(0)).norm();
    EXPECT_LE(first, step * (1 + 1e-9));
    for (Index k = 2; k < 11; ++k) EXPECT_NEAR((line.col(k) - line.col(k - 1)).norm(), step, 1e-9);
    least = std::min(least, first / step);
    most = std::max(most, first / step);
  }
  EXPECT_LT(least, 0.1);
  EXPECT_GT(most, 0.9);
  EXPECT_EQ(particles.points, particles_along(fibers, 12, 7).points);
  EXPECT_NE(particles.points, particles_along(fibers, 12, 8).points);
}

TEST(MassSpringLayout, fibers_on_a_lattice_are_found_on_it) {
  const Polylines particles = lattice_of_fibers(5, 4);
  const auto lattice = fiber_lattice(particles);
  ASSERT_EQ(lattice.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    ASSERT_EQ(lattice[i].size(), 5u);
    for (std::size_t j = 0; j + 1 < 5; ++j) {
      const Vec3 here = particles.line(lattice[i][j]).col(0);
      EXPECT_NEAR((here - particles.line(lattice[i][j + 1]).col(0)).norm(), 0.01, 1e-9);
      if (i + 1 == 5) continue;
      EXPECT_NEAR((here - particles.line(lattice[i + 1][j]).col(0)).norm(), 0.013, 1e-9);
    }
  }
}

TEST(MassSpringLayout, cubic_lattices_have_6_and_26_neighbors_inside) {
  const Polylines particles = lattice_of_fibers(4, 5);
  const auto six = neighbor_counts(cubic_pairs(particles, false)), all = neighbor_counts(cubic_pairs(particles, true));
  int inner = 0;
  for (Index f = 0; f < particles.count(); ++f)
    for (Index k = 0; k < 5; ++k) {
      const Vec3 place = particles.line(f).col(k) / 0.01;
      const bool is_inner = place.x() > 1 && place.x() < 3 && place.y() > 0.5 && place.y() < 2.5 && k > 0 && k < 4;
      const Index p = particles.begin(f) + k;
      if (is_inner) {
        EXPECT_EQ(six.at(p), 6);
        EXPECT_EQ(all.at(p), 26);
        ++inner;
      } else {
        EXPECT_LT(six.at(p), 6);
        EXPECT_LT(all.at(p), 26);
      }
    }
  EXPECT_EQ(inner, 12);
  for (const auto& [a, b] : cubic_pairs(particles, false))
    EXPECT_LT((particles.points.col(a) - particles.points.col(b)).norm(), 0.0131) << "beside each other";
}

TEST(MassSpringLayout, nearest_joins_each_with_as_many_of_its_nearest_as_asked) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<Real> uniform(-1, 1);
  Points points(3, 80);
  for (Index i = 0; i < 80; ++i) points.col(i) = Vec3(uniform(generator), uniform(generator), uniform(generator));
  const SpringPairs pairs = nearest_pairs(points, 7);
  EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
  EXPECT_EQ(std::adjacent_find(pairs.begin(), pairs.end()), pairs.end());
  SpringPairs expected;
  for (Index p = 0; p < 80; ++p) {
    std::vector<std::pair<Real, Index>> others;
    for (Index q = 0; q < 80; ++q)
      if (q != p) others.emplace_back((points.col(p) - points.col(q)).norm(), q);
    std::sort(others.begin(), others.end());
    for (std::size_t i = 0; i < 7; ++i)
      expected.push_back({std::min(p, others[i].second), std::max(p, others[i].second)});
  }
  std::sort(expected.begin(), expected.end());
  expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
  EXPECT_EQ(pairs, expected);
}

TEST(MassSpringLayout, particles_are_fixed_to_the_bone_that_they_are_near) {
  const Scene scene = tube_scene();
  Points points(3, 4);
  points.col(0) = Vec3(0.017, 0, 0.05);      // 2 mm from the upper bone
  points.col(1) = Vec3(0.017, 0, -0.05);     // from the lower one
  points.col(2) = Vec3(0.03, 0, 0.05);       // 15 mm away
  points.col(3) = Vec3(0.0255, 0, -0.0795);  // at the muscle's lower end
  const std::vector<NearestBone> bones = nearest_bones(scene, points);
  EXPECT_NEAR(bones[0].distance, 0.002, 1e-9);
  EXPECT_EQ(bones[2].body, 0);
  EXPECT_NEAR(bones[2].distance, 0.015, 1e-9);
  const Muscle& muscle = scene.muscles[0];
  EXPECT_EQ(fixed_bodies(muscle, points, bones, FixedNear::bones, 0.003), (std::vector<Index>{0, 1, -1, -1}));
  EXPECT_EQ(fixed_bodies(muscle, points, bones, FixedNear::attachments, 0.003), (std::vector<Index>{-1, -1, -1, 1}));
}

TEST(MassSpringLayout, boundary_fibers_are_those_nearest_to_the_surface) {
  const Polylines particles = lattice_of_fibers(5, 6);
  // A surface just outside of the lattice.
  const TriangleMesh around = shapes::sphere(Vec3(0.026, 0.02, 0.025), 0.06, 4);
  const std::vector<char> on_boundary = on_boundary_fibers(particles, around.vertices);
  const auto lattice = fiber_lattice(particles);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_TRUE(on_boundary[static_cast<std::size_t>(particles.begin(lattice[i][0]))]) << i;
  for (Index f = 0; f < particles.count(); ++f)
    for (Index p = particles.begin(f) + 1; p < particles.end(f); ++p)
      EXPECT_EQ(on_boundary[static_cast<std::size_t>(p)], on_boundary[static_cast<std::size_t>(particles.begin(f))]);
  // Vertices beside one fiber alone.
  Points beside = particles.line(3);
  beside.colwise() += Vec3(0.001, 0.001, 0);
  const std::vector<char> one = on_boundary_fibers(particles, beside);
  EXPECT_EQ(std::count(one.begin(), one.end(), 1), 6);
}

}  // namespace gracilis::mass_spring
