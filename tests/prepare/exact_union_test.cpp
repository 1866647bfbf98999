#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/mesh_pieces.hpp>
#include <gracilis/prepare/cgal.hpp>
#include <gracilis/prepare/solids.hpp>

#include "shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

/// What either of two solids encloses, also where their walls lie in each other.
namespace gracilis {
namespace {

using shapes::box;

constexpr Real side = 0.01;  // m

TEST(ExactUnion, of_flush_boxes_has_no_wall_between_them) {
  const TriangleMesh left = box(Vec3::Zero(), Vec3(2, 1, 1) * side),
                     right = box(Vec3(1, 0, 0) * side, Vec3(3, 1, 1) * side),
                     beside = box(Vec3(2, 0, 0) * side, Vec3(3, 1, 1) * side);
  for (const TriangleMesh& other : {right, beside}) {
    const std::optional<TriangleMesh> whole = exact_union(left, other);
    ASSERT_TRUE(whole);
    EXPECT_TRUE(is_solid(*whole));
    EXPECT_NEAR(volume_of(*whole), 3 * side * side * side, 1e-12);
    EXPECT_NEAR(surface_area(whole->vertices, whole->faces), 14 * side * side, 1e-10);
    EXPECT_EQ(pieces_of(*whole).size(), 1u);
  }
}

/// Boxes whose walls, edges and corners lie in each other; CGAL's own union of these ends in a loop for ever.
TEST(ExactUnion, of_solids_that_touch_in_edges_and_points_comes_to_an_end) {
  const std::vector<std::vector<std::array<Vec3, 2>>> heaps = {
      {{{{0, 2, 1}, {1, 3, 3}}}, {{{0, 0, 2}, {2, 3, 3}}}, {{{3, 2, 1}, {4, 5, 2}}}, {{{1, 3, 1}, {4, 6, 4}}}},
      {{{{0, 1, 0}, {2, 3, 2}}}, {{{0, 3, 2}, {1, 4, 4}}}, {{{0, 0, 0}, {2, 1, 1}}}, {{{1, 1, 3}, {2, 2, 5}}}},
      {{{{2, 0, 1}, {3, 2, 4}}}, {{{1, 2, 2}, {3, 5, 4}}}, {{{3, 3, 0}, {4, 5, 2}}}, {{{2, 3, 1}, {4, 4, 3}}}}};
  for (const auto& heap : heaps) {
    TriangleMesh whole = box(heap[0][0] * side, heap[0][1] * side);
    Real largest = volume_of(whole);
    for (std::size_t k = 1; k < heap.size(); ++k) {
      const TriangleMesh next = box(heap[k][0] * side, heap[k][1] * side);
      const std::optional<TriangleMesh> both = exact_union(whole, next);
      if (!both) continue;
      largest = std::max(largest, volume_of(next));
      EXPECT_GT(volume_of(*both), 0.99 * largest);
      whole = *both;
    }
  }
}

}  // namespace
}  // namespace gracilis
