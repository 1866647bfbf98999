#include <gracilis/dynamics/contact/mesh/bounds_lanes.hpp>

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

/// Calls check(tree, lanes), which returns how many it found, again and again for trees that fill groups or do not.
template <class Check>
void check_at_all_sizes(const Check& check) {
  for (const Index count : {0, 1, 15, 16, 17, 100}) {
    const PatchTree tree = tree_of(count);
    BoundsLanes lanes;
    lanes.load(tree, numbers_below(count));
    std::size_t all = 0;
    for (int repeat = 0; repeat < 200; ++repeat) all += check(tree, lanes);
    EXPECT_GE(all, static_cast<std::size_t>(count));
  }
}

float squared_distance(const PatchTree::Box& box, const Eigen::Array4f& point) {
  return (box.low - point).max(point - box.high).max(0.0f).square().sum();
}

}  // namespace

TEST(BoundsLanes, find_what_may_meet_like_one_after_the_other) {
  check_at_all_sizes([](const PatchTree& tree, const BoundsLanes& lanes) {
    const PatchTree::Bounds near{random_box(0.1f, 0.05f), random_box(1, 0.3f)};
    std::vector<Index> expected, found;
    for (std::size_t i = 0; i < tree.bounds.size(); ++i)
      if (may_meet(near, tree.bounds[i], 0.02f)) expected.push_back(static_cast<Index>(i));
    find_meeting_patches(lanes, near, 0.02f, found);
    EXPECT_EQ(found, expected);
    return found.size();
  });
}

TEST(BoundsLanes, find_what_is_near_a_point_and_may_face_it_like_one_after_the_other) {
  bool faces = false;
  check_at_all_sizes([&](const PatchTree& tree, const BoundsLanes& lanes) {
    faces = !faces;
    const Eigen::Array4f p = random_corner(0.1f), outward = random_corner(faces ? 1 : 0);
    std::vector<NearPatch> found;
    find_near_patches(lanes, p.head<3>(), outward.head<3>(), 0.05f, found);
    std::size_t next = 0;
    for (std::size_t i = 0; i < tree.bounds.size(); ++i) {
      const PatchTree::Bounds& bounds = tree.bounds[i];
      const float distance2 = squared_distance(bounds.places, p);
      if (!(distance2 <= 0.05f * 0.05f)) continue;
      if (!((outward * bounds.normals.low).min(outward * bounds.normals.high).sum() <= 0)) continue;
      EXPECT_LT(next, found.size());
      if (next >= found.size()) break;
      EXPECT_EQ(found[next].node, static_cast<Index>(i));
      EXPECT_NEAR(found[next].distance2, distance2, 1e-8);
      ++next;
    }
    EXPECT_EQ(next, found.size());
    return found.size();
  });
}

}  // namespace gracilis
