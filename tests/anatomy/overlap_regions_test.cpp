#include <gracilis/anatomy/overlap/overlap_sides.hpp>

#include <gracilis/geometry/measures.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace gracilis {
namespace {

/// A tube along z with 12 vertices around and 21 rings, one millimeter apart, and its caps.
const TriangleMesh& tube_of_rings() {
  static const TriangleMesh mesh = shapes::cylinder(0.004, 0.02, 12, 20);
  return mesh;
}

Index ring_of(Index v) { return v / 12; }

/// The vertices for which `is_inside` holds lie 1 mm deep or as deep as `depth` says, their ways out as `way` says.
InsideVertices inside_where(
    const TriangleMesh& mesh, const std::function<bool(Index)>& is_inside, const std::function<Vec3(Index)>& way,
    const std::function<Real(Index)>& depth = [](Index) { return 0.001; }) {
  InsideVertices inside;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (is_inside(v)) inside.vertices.push_back(v), inside.depths.push_back(depth(v));
  inside.outward.resize(3, static_cast<Index>(inside.vertices.size()));
  for (std::size_t i = 0; i < inside.vertices.size(); ++i)
    inside.outward.col(static_cast<Index>(i)) = way(inside.vertices[i]);
  return inside;
}

OverlapSides sides_where(const InsideVertices& inside, const std::vector<char>& in_tendon = {}) {
  static const TriangleMesh other = shapes::box({-1, -1, -1}, {1, 1, 1});
  return overlap_sides({0, 1, inside, {}}, {tube_of_rings(), in_tendon}, {other, {}});
}

/// A patch of three by three vertices: rings around `ring`, columns around `column`.
bool in_patch(Index v, Index ring, Index column) {
  return v < 21 * 12 && std::abs(ring_of(v) - ring) <= 1 && std::abs(v % 12 - column) <= 1;
}

}  // namespace

TEST(OverlapRegions, lead_the_same_way_while_their_ways_are_at_most_sixty_degrees_from_their_mean_on_average) {
  const auto fanned = [](Real angle) {
    // A column each aside, and a middle one along the mean, each with as much area.
    return sides_where(inside_where(
        tube_of_rings(), [](Index v) { return in_patch(v, 10, 5) && v % 12 != 5; },
        [angle](Index v) { return Vec3(std::cos(angle), (v % 12 == 4 ? 1 : -1) * std::sin(angle), 0); }));
  };
  // The columns beside the middle one do not hang together: each has its own way.
  EXPECT_LT(
      (fanned(radians(80)).first_ways.col(10 * 12 + 4) - Vec3(std::cos(radians(80)), std::sin(radians(80)), 0)).norm(),
      1e-12);
  const auto together = [](Real angle) {
    return sides_where(inside_where(
        tube_of_rings(),
        [](Index v) { return v < 21 * 12 && std::abs(ring_of(v) - 10) <= 1 && (v % 12 == 4 || v % 12 == 5); },
        [angle](Index v) { return Vec3(std::cos(angle), (v % 12 == 4 ? 1 : -1) * std::sin(angle), 0); }));
  };
  const OverlapSides narrow = together(radians(59)), wide = together(radians(61));
  for (const Index v : {Index{10 * 12 + 4}, Index{11 * 12 + 5}}) {
    EXPECT_LT((narrow.first_ways.col(v) - Vec3::UnitX()).norm(), 1e-12) << "unit";
    EXPECT_EQ(narrow.first_astray[static_cast<std::size_t>(v)], 0);
    EXPECT_TRUE(wide.first_ways.col(v).isZero());
    EXPECT_EQ(wide.first_astray[static_cast<std::size_t>(v)], 0.001);
  }
  EXPECT_FALSE(narrow.is_through);
  EXPECT_TRUE(wide.is_through) << "nothing else lies inside";
  EXPECT_TRUE(narrow.first_ways.col(0).isZero()) << "outside";
}

TEST(OverlapRegions, ways_count_by_the_area_around_their_vertices) {
  // A cap's middle stands for twelve triangles, the ring around it for as much on the side besides.
  const TriangleMesh& mesh = tube_of_rings();
  const Eigen::VectorXd areas = vertex_areas(mesh.vertices, mesh.faces);
  const Index middle = 21 * 12;
  const OverlapSides sides = sides_where(inside_where(
      mesh, [&](Index v) { return v == middle || ring_of(v) == 0; },
      [&](Index v) { return v == middle ? Vec3(Vec3::UnitX()) : Vec3(Vec3::UnitY()); }));
  Real of_ring = 0;
  for (Index v = 0; v < 12; ++v) of_ring += areas[v];
  const Vec3 expected = Vec3(areas[middle], of_ring, 0).normalized();
  EXPECT_LT((sides.first_ways.col(3) - expected).norm(), 1e-12);
}

TEST(OverlapRegions, each_without_a_side_goes_as_far_astray_as_its_deepest_vertex) {
  const OverlapSides sides = sides_where(inside_where(
      tube_of_rings(), [](Index v) { return in_patch(v, 5, 5) || in_patch(v, 15, 5); },
      [](Index v) {
        return ring_of(v) > 10 ? Vec3(Vec3::UnitZ()) : v % 2 == 0 ? Vec3(Vec3::UnitX()) : Vec3(-Vec3::UnitX());
      },
      [](Index v) { return v == 4 * 12 + 4 ? 0.003 : 0.001; }));
  for (Index v = 0; v < 21 * 12; ++v) {
    const Real astray = sides.first_astray[static_cast<std::size_t>(v)];
    EXPECT_EQ(astray, in_patch(v, 5, 5) ? 0.003 : 0) << v;
    EXPECT_EQ(sides.first_ways.col(v).isZero(), !in_patch(v, 15, 5)) << v;
  }
}

TEST(OverlapRegions, one_that_cuts_off_more_than_itself_has_no_side_and_what_it_cuts_off_goes_astray_with_it) {
  // A belt around the tube with one way out all around, `below` rings under it, and more above.
  const auto belt = [](Index begin, Index end) {
    return sides_where(inside_where(
        tube_of_rings(), [=](Index v) { return v < 21 * 12 && ring_of(v) >= begin && ring_of(v) < end; },
        [](Index) { return Vec3(Vec3::UnitX()); }, [](Index v) { return ring_of(v) == 6 ? 0.002 : 0.001; }));
  };
  const OverlapSides thin = belt(6, 8), thick = belt(3, 12);
  for (Index v = 0; v < 21 * 12; ++v) {
    EXPECT_EQ(thin.first_astray[static_cast<std::size_t>(v)], ring_of(v) < 8 ? 0.002 : 0) << v;
    EXPECT_EQ(thick.first_astray[static_cast<std::size_t>(v)], 0) << "larger than what it cuts off";
    EXPECT_EQ(thick.first_ways.col(v).isZero(), ring_of(v) < 3 || ring_of(v) >= 12);
  }
  EXPECT_TRUE(thin.is_through);
  EXPECT_FALSE(thick.is_through);
}

TEST(OverlapRegions, a_surface_has_a_side_when_half_of_its_belly_that_lies_inside_does) {
  // Two patches of one size, the upper one without a side.
  const InsideVertices inside = inside_where(
      tube_of_rings(), [](Index v) { return in_patch(v, 5, 5) || in_patch(v, 15, 5); },
      [](Index v) { return ring_of(v) < 10 || v % 2 == 0 ? Vec3(Vec3::UnitX()) : Vec3(-Vec3::UnitX()); });
  EXPECT_FALSE(sides_where(inside).is_through) << "just half";
  std::vector<char> in_tendon(static_cast<std::size_t>(tube_of_rings().vertex_count()), 0);
  in_tendon[4 * 12 + 4] = 1;
  EXPECT_TRUE(sides_where(inside, in_tendon).is_through) << "less than half of the belly";
  in_tendon.assign(in_tendon.size(), 0);
  in_tendon[14 * 12 + 4] = 1;
  EXPECT_FALSE(sides_where(inside, in_tendon).is_through);
}

TEST(OverlapRegions, one_surface_with_a_side_is_enough) {
  const TriangleMesh& mesh = tube_of_rings();
  const auto patch = [&](bool has_side) {
    return inside_where(
        mesh, [](Index v) { return in_patch(v, 10, 5); },
        [=](Index v) { return has_side || v % 2 == 0 ? Vec3(Vec3::UnitX()) : Vec3(-Vec3::UnitX()); });
  };
  for (const bool first : {true, false})
    for (const bool second : {true, false}) {
      const OverlapSides sides = overlap_sides({0, 1, patch(first), patch(second)}, {mesh, {}}, {mesh, {}});
      EXPECT_EQ(sides.is_through, !first && !second);
      EXPECT_EQ(sides.second_ways.isZero(), !second);
      EXPECT_EQ(*std::max_element(sides.second_astray.begin(), sides.second_astray.end()), second ? 0 : 0.001);
    }
}

}  // namespace gracilis
