#include <gracilis/anatomy/overlap/overlap_report.hpp>
#include <gracilis/anatomy/overlap/overlap_sides.hpp>
#include <gracilis/anatomy/overlap/rest_overlap.hpp>
#include <gracilis/geometry/rotations.hpp>

#include <scenes_for_tests.hpp>
#include <shapes.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace gracilis {
namespace {

using testing::HasSubstr;

TriangleMesh moved(TriangleMesh mesh, const Eigen::Affine3d& motion) {
  mesh.vertices = motion * mesh.vertices;
  return mesh;
}

/// A tube with radius 10 mm and length 100 mm about a line through `center`.
TriangleMesh tube(const Vec3& center, const Vec3& along, Real radius = 0.01) {
  Eigen::Affine3d motion = Eigen::Affine3d::Identity();
  motion.translate(center).rotate(turn_from_to(Vec3::UnitZ(), along)).translate(Vec3(0, 0, -0.05));
  return moved(shapes::cylinder(radius, 0.1, 32, 40), motion);
}

OverlapSides sides_of(const TriangleMesh& a, const TriangleMesh& b) {
  const std::vector<RestOverlap> overlaps = rest_overlaps({a, b});
  EXPECT_EQ(overlaps.size(), 1u);
  return overlaps.empty() ? OverlapSides() : overlap_sides(overlaps.front(), {a, {}}, {b, {}});
}

/// How many vertices lie in regions without a side, or are cut off by one.
long count(const std::vector<Real>& astray) {
  return std::count_if(astray.begin(), astray.end(), [](Real depth) { return depth > 0; });
}

}  // namespace

TEST(RestOverlap, of_two_spheres_is_their_known_lens) {
  // Triangles with a circumradius of 0.85 mm lie up to 18 µm within the sphere.
  const Real radius = 0.02, distance = 0.036, flatness = 2e-5;
  const TriangleMesh a = shapes::sphere(Vec3::Zero(), radius, 5), b = shapes::sphere({distance, 0, 0}, radius, 5);
  const std::vector<RestOverlap> overlaps = rest_overlaps({a, b});
  ASSERT_EQ(overlaps.size(), 1u);
  EXPECT_EQ(overlaps[0].first, 0);
  EXPECT_EQ(overlaps[0].second, 1);
  Index expected = 0;
  for (Index v = 0; v < a.vertex_count(); ++v)
    expected += (Vec3(a.vertices.col(v)) - Vec3(distance, 0, 0)).norm() < radius - 1e-5;
  EXPECT_NEAR(static_cast<Real>(overlaps[0].of_first.vertices.size()), static_cast<Real>(expected),
              0.05 * static_cast<Real>(expected));
  EXPECT_EQ(overlaps[0].of_first.vertices.size(), overlaps[0].of_second.vertices.size());
  EXPECT_NEAR(overlaps[0].deepest(), 2 * radius - distance, flatness);
  for (std::size_t i = 0; i < overlaps[0].of_first.vertices.size(); ++i) {
    const Vec3 p = a.vertices.col(overlaps[0].of_first.vertices[i]);
    EXPECT_NEAR(overlaps[0].of_first.depths[i], radius - (p - Vec3(distance, 0, 0)).norm(), flatness);
  }
}

TEST(RestOverlap, two_surfaces_lie_as_deep_in_each_other_around_a_vertex_as_free_ones_do_within_the_slide_reach) {
  const Real radius = 0.02, distance = 0.036;
  const TriangleMesh a = shapes::sphere(Vec3::Zero(), radius, 4), b = shapes::sphere({distance, 0, 0}, radius, 4);
  const std::vector<RestOverlap> overlaps = rest_overlaps({a, b});
  ASSERT_EQ(overlaps.size(), 1u);
  const std::vector<char> all(static_cast<std::size_t>(a.vertex_count()), 1), none(all.size(), 0);
  const DepthsAround depths = depths_around(overlaps[0], {a.vertices, all}, {b.vertices, all});
  // The deepest of both lie at 16 and 20 mm on the axis.
  for (Index v = 0; v < a.vertex_count(); ++v) {
    const Vec3 p = a.vertices.col(v);
    const float found = depths.of_first[static_cast<std::size_t>(v)];
    if ((p - Vec3(0.016, 0, 0)).norm() < slide_reach - 0.001) {
      EXPECT_NEAR(found, 0.004, 1e-4) << p.transpose();
    } else if ((p - Vec3(0.02, 0, 0)).norm() > slide_reach + 0.006) {
      EXPECT_EQ(found, 0) << p.transpose();
    }
  }
  EXPECT_TRUE(depths_around(overlaps[0], {a.vertices, none}, {b.vertices, none}).of_first.empty());
  EXPECT_NEAR(*std::max_element(depths.of_second.begin(), depths.of_second.end()), 0.004, 1e-4);
}

TEST(RestOverlap, surfaces_that_lie_apart_or_only_have_boxes_in_common_do_not_overlap) {
  const TriangleMesh a = shapes::sphere(Vec3::Zero(), 0.02, 3);
  EXPECT_TRUE(rest_overlaps({a, shapes::sphere({0.05, 0, 0}, 0.02, 3)}).empty());
  EXPECT_TRUE(rest_overlaps({a, shapes::sphere({0.03, 0.03, 0}, 0.02, 3)}).empty());
  EXPECT_TRUE(rest_overlaps(std::vector<TriangleMesh>{a}).empty());
}

TEST(RestOverlap, vertices_on_a_surface_are_not_inside_it) {
  // Both end in the same two planes.
  for (const RestOverlap& overlap :
       rest_overlaps({tube(Vec3::Zero(), Vec3::UnitZ()), tube({0.015, 0, 0}, Vec3::UnitZ())}))
    for (const InsideVertices& inside : {overlap.of_first, overlap.of_second})
      for (const Real depth : inside.depths) EXPECT_GT(depth, 1e-6);
}

TEST(RestOverlap, a_vertex_in_two_surfaces_counts_once) {
  const TriangleMesh ball = shapes::sphere(Vec3::Zero(), 0.01, 2);
  const std::vector<RestOverlap> overlaps =
      rest_overlaps({ball, shapes::sphere(Vec3::Zero(), 0.02, 2), shapes::sphere(Vec3::Zero(), 0.03, 2)});
  EXPECT_EQ(count_inside(overlaps), 2 * ball.vertex_count());
}

TEST(OverlapSides, tubes_that_lie_in_each_others_flanks_have_a_side) {
  const TriangleMesh a = tube(Vec3::Zero(), Vec3::UnitZ());
  for (const Vec3& along : {Vec3(0, 0, 1), Vec3(0, 1, 0)}) {
    const OverlapSides sides = sides_of(a, tube({0.015, 0, 0}, along));
    EXPECT_FALSE(sides.is_through);
    EXPECT_EQ(count(sides.first_astray), 0);
    EXPECT_EQ(count(sides.second_astray), 0);
  }
}

TEST(OverlapSides, all_that_lies_inside_together_has_one_way_out) {
  const TriangleMesh a = tube(Vec3::Zero(), Vec3::UnitZ()), b = tube({0.015, 0, 0}, Vec3::UnitZ());
  const std::vector<RestOverlap> overlaps = rest_overlaps({a, b});
  ASSERT_EQ(overlaps.size(), 1u);
  const OverlapSides sides = overlap_sides(overlaps.front(), {a, {}}, {b, {}});
  Points expected = Points::Zero(3, a.vertex_count());
  for (const Index v : overlaps.front().of_first.vertices) expected.col(v) = -Vec3::UnitX();
  // The middle one of the seven vertices in a row is as near to either of two of the 32 faces around the other tube.
  EXPECT_LT((sides.first_ways - expected).cwiseAbs().maxCoeff(), std::sin(pi / 32) / 6);
}

TEST(OverlapSides, a_tube_through_another_has_none_however_thick_the_other_is) {
  const TriangleMesh a = tube(Vec3::Zero(), Vec3::UnitZ());
  for (const Real radius : {0.004, 0.01, 0.02}) {
    const OverlapSides sides = sides_of(a, tube(Vec3::Zero(), Vec3::UnitX(), radius));
    EXPECT_TRUE(sides.is_through) << radius;
    EXPECT_GT(count(sides.first_astray), 0) << radius;
  }
}

TEST(OverlapSides, a_tendon_through_a_belly_has_none_but_leaves_the_rest_a_side) {
  const TriangleMesh belly = tube(Vec3::Zero(), Vec3::UnitZ()), tendon = tube(Vec3::Zero(), Vec3::UnitX(), 0.004);
  const std::vector<RestOverlap> overlaps = rest_overlaps({belly, tendon});
  ASSERT_EQ(overlaps.size(), 1u);
  const std::vector<char> all(static_cast<std::size_t>(tendon.vertex_count()), 1);
  const OverlapSides sides = overlap_sides(overlaps.front(), {belly, {}}, {tendon, all});
  EXPECT_FALSE(sides.is_through);
  EXPECT_GE(count(sides.second_astray), static_cast<long>(overlaps.front().of_second.vertices.size()));
  EXPECT_TRUE(overlap_sides(overlaps.front(), {belly, {}}, {tendon, {}}).is_through);
}

TEST(OverlapSides, a_tube_through_a_sheet_has_none) {
  const TriangleMesh sheet = shapes::sphere(Vec3::Zero(), 0.04, 5);
  Eigen::Affine3d flat = Eigen::Affine3d::Identity();
  flat.scale(Vec3(1, 1, 0.05));
  EXPECT_TRUE(sides_of(tube({0.005, 0, 0}, Vec3::UnitZ(), 0.006), moved(sheet, flat)).is_through);
}

/// The same surface with its vertices in another order; `order`: which was each.
static TriangleMesh renumbered(const TriangleMesh& mesh, const std::vector<Index>& order) {
  TriangleMesh result = mesh;
  std::vector<Index> now(order.size());
  for (std::size_t v = 0; v < order.size(); ++v) {
    result.vertices.col(static_cast<Index>(v)) = mesh.vertices.col(order[v]);
    now[static_cast<std::size_t>(order[v])] = static_cast<Index>(v);
  }
  for (Index& corner : result.faces.reshaped()) corner = now[static_cast<std::size_t>(corner)];
  return result;
}

TEST(OverlapSides, a_dent_beside_a_tube_that_is_cut_through_keeps_its_way_out_whatever_vertices_are_called) {
  const TriangleMesh cut = tube(Vec3::Zero(), Vec3::UnitZ());
  // One tube goes right through below, another presses into the flank above.
  const TriangleMesh through = tube({0, 0, -0.03}, Vec3::UnitX(), 0.012),
                     beside = tube({0.018, 0, 0.03}, Vec3::UnitY());
  std::vector<Index> order(static_cast<std::size_t>(cut.vertex_count()));
  std::iota(order.begin(), order.end(), 0);
  std::mt19937 chance(3);
  for (int round = 0; round < 8; ++round) {
    const TriangleMesh mesh = renumbered(cut, order);
    const OverlapSides sides = sides_of(mesh, shapes::both(through, beside));
    Index dented = 0, astray = 0;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const Vec3 p = mesh.vertices.col(v);
      const Real astray_here = sides.first_astray[static_cast<std::size_t>(v)];
      EXPECT_TRUE(p.z() < 0 || astray_here == 0) << round << ' ' << p.transpose();
      if (p.z() > 0 && !sides.first_ways.col(v).isZero()) {
        EXPECT_LT(sides.first_ways(0, v), -0.8) << round << ' ' << p.transpose();
        ++dented;
      }
      // The end below is cut off, and goes as far astray as the cut is deep.
      if (p.z() < -0.0421) {
        EXPECT_NEAR(astray_here, 0.012, 5e-4) << round << ' ' << p.transpose();
        ++astray;
      }
    }
    EXPECT_GT(dented, 3) << round;
    EXPECT_GT(astray, 32) << round;
    std::shuffle(order.begin(), order.end(), chance);
  }
}

TEST(OverlapReport, warns_of_free_vertices_in_bones_and_lets_attached_ones_be) {
  Scene scene;
  scene.muscles.emplace_back();
  scene.muscles[0].name = "tube";
  scene.muscles[0].surface = tube(Vec3::Zero(), Vec3::UnitZ());
  const auto ball = [](Real radius) {
    Bone bone;
    bone.name = "ball";
    bone.surface = shapes::sphere({0, 0, 0.1}, radius, 4);
    return bone;
  };
  const auto warnings = [&] { return overlap_warnings(report_overlaps(scene)); };
  Index top = 0;
  scene.muscles[0].surface.vertices.row(2).maxCoeff(&top);
  const Real height = scene.muscles[0].surface.vertices(2, top);
  scene.bones = {ball(0.1 - height - 0.001)};
  EXPECT_TRUE(warnings().empty()) << "beside each other";
  scene.bones = {ball(0.1 - height + 0.02)};
  const OverlapReport report = report_overlaps(scene);
  ASSERT_EQ(report.in_bones.size(), 1u);
  EXPECT_NEAR(report.in_bones[0].deepest, 0.02, 2e-3);
  ASSERT_EQ(warnings().size(), 1u);
  EXPECT_THAT(warnings()[0], HasSubstr("tube in ball"));
  EXPECT_THAT(warnings()[0], HasSubstr("check places and units"));
  Attachment end;
  for (Index v = 0; v < scene.muscles[0].surface.vertex_count(); ++v) end.vertices.push_back(v);
  scene.muscles[0].attachments = {end};
  EXPECT_TRUE(warnings().empty());
}

TEST(OverlapReport, warns_with_counts_and_names_the_deepest_first) {
  Scene scene;
  const auto add = [&](const char* name, const TriangleMesh& mesh) {
    scene.muscles.emplace_back();
    scene.muscles.back().name = name;
    scene.muscles.back().surface = mesh;
  };
  add("left", tube(Vec3::Zero(), Vec3::UnitZ()));
  EXPECT_TRUE(overlap_warnings(report_overlaps(scene)).empty());
  add("right", tube({0.018, 0, 0}, Vec3::UnitZ()));
  add("across", tube({0, 0, 0.03}, Vec3::UnitX()));
  const OverlapReport report = report_overlaps(scene);
  ASSERT_EQ(report.pairs.size(), 3u);
  EXPECT_EQ(report.of_vertices, 3 * scene.muscles[0].surface.vertex_count());
  EXPECT_EQ(report.pairs[2].first, "left");
  EXPECT_EQ(report.pairs[2].second, "right");
  EXPECT_NEAR(report.pairs[2].deepest(), 0.002, 1e-4);
  const std::vector<std::string> warnings = overlap_warnings(report);
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_THAT(warnings[0], HasSubstr("in 3 pairs"));
  EXPECT_THAT(warnings[0], HasSubstr(std::to_string(report.vertices) + " of " + std::to_string(report.of_vertices)));
  EXPECT_THAT(warnings[1], HasSubstr("pairs that pass through each other in the capture pose: 2, deepest "));
  EXPECT_THAT(warnings[1], HasSubstr("left and across ("));
}

}  // namespace gracilis
