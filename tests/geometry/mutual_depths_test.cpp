#include <gracilis/geometry/mutual_depths.hpp>
#include <gracilis/geometry/signed_distance.hpp>

#include <scenes_for_tests.hpp>

#include <gtest/gtest.h>

#include <map>

namespace gracilis {
namespace {

std::vector<Points> points_of(const std::vector<TriangleMesh>& surfaces) {
  std::vector<Points> points;
  for (const TriangleMesh& mesh : surfaces) points.push_back(mesh.vertices);
  return points;
}

std::vector<DepthInOther> depths_in(const std::vector<TriangleMesh>& surfaces) {
  return MutualDepths(surfaces).find(points_of(surfaces));
}

/// The same, vertex by vertex.
std::vector<DepthInOther> depths_by_distances(const std::vector<TriangleMesh>& surfaces) {
  std::vector<DepthInOther> depths;
  for (std::size_t s = 0; s < surfaces.size(); ++s)
    for (std::size_t other = 0; other < surfaces.size(); ++other) {
      if (other == s) continue;
      const SignedDistance distance(surfaces[other]);
      for (Index v = 0; v < surfaces[s].vertex_count(); ++v)
        if (const Real at = distance.query(surfaces[s].vertices.col(v)).distance; at < 0)
          depths.push_back({static_cast<Index>(s), v, static_cast<Index>(other), -at});
    }
  return depths;
}

void expect_same(const std::vector<DepthInOther>& found, const std::vector<DepthInOther>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].surface, expected[i].surface);
    EXPECT_EQ(found[i].vertex, expected[i].vertex);
    EXPECT_EQ(found[i].other, expected[i].other);
    EXPECT_NEAR(found[i].depth, expected[i].depth, 1e-12);
  }
}

}  // namespace

TEST(MutualDepths, of_surfaces_apart_are_none) {
  EXPECT_TRUE(depths_in({shapes::sphere({0, 0, 0}, 0.02, 3), shapes::sphere({0.05, 0, 0}, 0.02, 3)}).empty());
  EXPECT_TRUE(depths_in({shapes::sphere({0, 0, 0}, 0.02, 3)}).empty());
}

TEST(MutualDepths, are_those_of_each_vertex_by_its_signed_distance) {
  const std::vector<TriangleMesh> surfaces = {
      shapes::sphere({0, 0, 0}, 0.02, 3), shapes::sphere({0.03, 0.002, 0.001}, 0.02, 4),
      shapes::box({-0.05, -0.004, -0.004}, {0.05, 0.003, 0.003}), shapes::sphere({0.2, 0, 0}, 0.02, 2)};
  const std::vector<DepthInOther> found = depths_in(surfaces);
  EXPECT_GT(found.size(), 100u);
  expect_same(found, depths_by_distances(surfaces));
}

TEST(MutualDepths, of_a_surface_inside_another_are_those_of_all_its_vertices) {
  const std::vector<TriangleMesh> surfaces = {shapes::sphere({0.001, 0, 0}, 0.01, 2),
                                              shapes::sphere({0, 0, 0}, 0.02, 3)};
  const std::vector<DepthInOther> found = depths_in(surfaces);
  EXPECT_EQ(static_cast<Index>(found.size()), surfaces[0].vertex_count());
  expect_same(found, depths_by_distances(surfaces));
}

TEST(MutualDepths, where_surfaces_touch_in_shared_faces_are_nothing) {
  const std::vector<TriangleMesh> surfaces = {shapes::box({0, 0, 0}, {0.01, 0.01, 0.01}),
                                              shapes::box({0.01, 0, 0}, {0.02, 0.01, 0.01})};
  for (const DepthInOther& each : depths_in(surfaces)) EXPECT_LT(each.depth, 1e-12);
  const TriangleMesh ball = shapes::sphere({0, 0, 0}, 0.02, 3);
  for (const DepthInOther& each : depths_in({ball, ball})) EXPECT_LT(each.depth, 1e-12);
}

TEST(MutualDepths, do_not_depend_on_how_far_away_the_surfaces_are) {
  std::vector<TriangleMesh> surfaces = {shapes::sphere({0, 0, 0}, 0.02, 3),
                                        shapes::sphere({0.03, 0.002, 0.001}, 0.02, 3)};
  const std::vector<DepthInOther> here = depths_in(surfaces);
  for (TriangleMesh& mesh : surfaces) mesh.vertices.colwise() += Vec3(3000, -2000, 5000);
  const std::vector<DepthInOther> there = depths_in(surfaces);
  ASSERT_EQ(here.size(), there.size());
  for (std::size_t i = 0; i < here.size(); ++i) EXPECT_NEAR(here[i].depth, there[i].depth, 1e-9);
}

TEST(MutualDepths, follow_surfaces_that_deform) {
  std::vector<TriangleMesh> surfaces = {shapes::sphere({0, 0, 0}, 0.02, 3), shapes::sphere({0.05, 0, 0}, 0.02, 3)};
  const MutualDepths depths(surfaces);
  for (int step = 0; step < 5; ++step) {
    surfaces[1].vertices.row(0).array() -= 0.004;
    surfaces[1].vertices.row(1) *= 1.1;
    expect_same(depths.find(points_of(surfaces)), depths_by_distances(surfaces));
  }
}

}  // namespace gracilis
