#include <gracilis/dynamics/bounds_lanes.hpp>

#include <gtest/gtest.h>

#include <random>

namespace gracilis {

namespace {

std::mt19937 random_numbers(5);

Eigen::Array4f random_corner(float size) {
  std::uniform_real_distribution<float> number(-size, size);
  return {number(random_numbers), number(random_numbers), number(random_numbers), 0};
}

PatchTree::Box random_box(float size, float extent) {
  PatchTree::Box box;
  const Eigen::Array4f corner = random_corner(size);
  box.extend(corner);
  box.extend(Eigen::Array4f(corner + random_corner(extent)));
  return box;
}

/// Boxes within 0.1 m, whose normals point anywhere.
PatchTree tree_of(Index count) {
  PatchTree tree;
  for (Index i = 0; i < count; ++i) tree.bounds.push_back({random_box(0.1f, 0.02f), random_box(1, 0.3f)});
  return tree;
}

std::vector<Index> numbers_below(Index count) {
  std::vector<Index> numbers;
  for (Index i = 0; i < count; ++i) numbers.push_back(i);
  return numbers;
}

}  // namespace

TEST(BoundsLanes, find_what_may_meet_like_one_after_the_other) {
  for (const Index count : {0, 1, 15, 16, 17, 100}) {
    const PatchTree tree = tree_of(count);
    BoundsLanes lanes;
    lanes.load(tree, numbers_below(count));
    Index all = 0;
    for (int repeat = 0; repeat < 200; ++repeat) {
      const PatchTree::Bounds near{random_box(0.1f, 0.05f), random_box(1, 0.3f)};
      std::vector<Index> expected, found;
      for (Index i = 0; i < count; ++i)
        if (may_meet(near, tree.bounds[static_cast<std::size_t>(i)], 0.02f)) expected.push_back(i);
      find_meeting_patches(lanes, near, 0.02f, found);
      EXPECT_EQ(found, expected);
      all += static_cast<Index>(found.size());
    }
    EXPECT_GE(all, count);
  }
}

TEST(BoundsLanes, find_what_is_near_a_point_and_may_face_it_like_one_after_the_other) {
  for (const Index count : {0, 1, 15, 16, 17, 100}) {
    const PatchTree tree = tree_of(count);
    BoundsLanes lanes;
    lanes.load(tree, numbers_below(count));
    Index all = 0;
    for (int repeat = 0; repeat < 200; ++repeat) {
      const Eigen::Array4f p = random_corner(0.1f), outward = repeat % 2 == 0 ? random_corner(1) : random_corner(0);
      std::vector<NearPatch> found;
      find_near_patches(lanes, p.head<3>(), outward.head<3>(), 0.05f, found);
      std::size_t next = 0;
      for (Index i = 0; i < count; ++i) {
        const PatchTree::Bounds& bounds = tree.bounds[static_cast<std::size_t>(i)];
        if (!(bounds.places.squared_distance(p) <= 0.05f * 0.05f)) continue;
        if (!((outward * bounds.normals.low).min(outward * bounds.normals.high).sum() <= 0)) continue;
        ASSERT_LT(next, found.size());
        EXPECT_EQ(found[next].node, i);
        EXPECT_NEAR(found[next].distance2, bounds.places.squared_distance(p), 1e-8);
        ++next;
      }
      EXPECT_EQ(next, found.size());
      all += static_cast<Index>(found.size());
    }
    EXPECT_GE(all, count);
  }
}

}  // namespace gracilis
