#include <gracilis/anatomy/sections/sheet.hpp>

#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/mesh_inspection.hpp>
#include <gracilis/scene/section_line.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace gracilis {
namespace {

/// Corners of a prism with this many sections 10 mm apart: heads at x = 0, 20, 40 mm, a radius of 5 mm around them.
Points prism_corners(Index sections, Index rays, Index side) {
  Points corners(3, sections * rays);
  for (Index k = 0; k < sections; ++k)
    for (Index i = 0; i < rays; ++i) {
      const SheetCorner corner = sheet_corner(rays, side, 3, static_cast<Real>(i));
      const Real x = 0.02 * (static_cast<Real>(corner.head) + corner.next);
      corners.col(k * rays + i) = Vec3(x + 0.005 * std::cos(corner.angle), 0.005 * std::sin(corner.angle), 0.01 * k);
    }
  return corners;
}

/// Two heads of 0.1 m along z, 20 mm apart, whose last quarter is tendon, and three sections between their ends.
Muscle two_heads() {
  Muscle muscle;
  for (const Real x : {0.0, 0.02}) {
    ActionLine head;
    head.points = (Points(3, 2) << x, x, 0, 0, 0, 0.1).finished();
    head.bodies = {0, 0};
    head.shares = {0, 0.25, 0.5, 0.75, 1};
    head.tendon = 0.025;
    muscle.action_line.heads.push_back(head);
  }
  muscle.action_line.rays = 12;
  muscle.action_line.side = 2;
  return muscle;
}

}  // namespace

TEST(SheetCorner, the_first_is_at_the_last_heads_edge_and_the_opposite_one_at_the_first_heads) {
  const SheetCorner last = sheet_corner(12, 2, 3, 0), first = sheet_corner(12, 2, 3, 6);
  EXPECT_EQ(last.head, 1u);
  EXPECT_NEAR(last.next, 1, 1e-12);
  EXPECT_NEAR(last.angle, 0, 1e-12);
  EXPECT_EQ(first.head, 0u);
  EXPECT_NEAR(first.next, 0, 1e-12);
  EXPECT_NEAR(first.angle, pi, 1e-12);
}

TEST(SheetCorner, those_of_a_side_lie_evenly_between_the_outer_heads_and_as_those_opposite) {
  // Two parts on each side about corner 3: at 2, 3 and 4 from the last head to the first.
  const Real places[] = {2, 2, 2, 1, 0, 0, 0};
  for (Index i = 0; i <= 6; ++i) {
    const SheetCorner corner = sheet_corner(12, 2, 3, static_cast<Real>(i));
    EXPECT_NEAR(static_cast<Real>(corner.head) + corner.next, places[i], 1e-12) << i;
    EXPECT_NEAR(corner.angle, 2 * pi * static_cast<Real>(i) / 12, 1e-12);
    const SheetCorner other = sheet_corner(12, 2, 3, static_cast<Real>(opposite_corner(12, i)));
    EXPECT_NEAR(static_cast<Real>(other.head) + other.next, places[i], 1e-12) << i;
    EXPECT_EQ(opposite_corner(12, opposite_corner(12, i)), i);
  }
  EXPECT_NEAR(sheet_corner(12, 2, 3, 2.5).next, 0.5, 1e-12) << "between corners, too";
  EXPECT_NEAR(sheet_corner(12, 4, 2, 2).next, 0.75, 1e-12) << "four parts";
}

TEST(SheetFaces, close_a_prism_of_known_volume) {
  for (const Index rays : {8, 10, 12, 14})
    for (const Index sections : {2, 5}) {
      const Points corners = prism_corners(sections, rays, 2);
      const TriangleMesh mesh{sheet_vertices(corners, rays), sheet_faces(sections, rays)};
      const MeshReport report = inspect_mesh(mesh);
      EXPECT_TRUE(report.is_closed() && report.is_manifold() && report.is_oriented()) << rays << ' ' << sections;
      EXPECT_EQ(mesh.vertex_count(), sections * rays + 2);
      Real twice_area = 0;
      for (Index i = 0; i < rays; ++i) {
        const Vec3 a = corners.col(i), b = corners.col((i + 1) % rays);
        twice_area += a.x() * b.y() - a.y() * b.x();
      }
      EXPECT_NEAR(enclosed_volume(mesh.vertices, mesh.faces), twice_area / 2 * 0.01 * (sections - 1), 1e-15);
    }
}

TEST(SheetFaces, the_vertices_that_close_the_ends_lie_in_their_middle) {
  const Points vertices = sheet_vertices(prism_corners(4, 12, 2), 12);
  ASSERT_EQ(vertices.cols(), 50);
  // Of the corners 2 and 3, and those opposite: at x of the last head's flank and of the middle head.
  EXPECT_NEAR(vertices(1, 48), 0, 1e-12);
  EXPECT_NEAR(vertices(2, 48), 0, 1e-12);
  EXPECT_NEAR(vertices(2, 49), 0.03, 1e-12);
  EXPECT_NEAR(vertices(0, 48), (0.04 + 0.005 * std::cos(pi / 3) + 0.02) / 2, 1e-12);
  EXPECT_NEAR(vertices(0, 49), vertices(0, 48), 1e-12);
}

TEST(LineShares, of_a_sheets_vertices_are_their_corners_places) {
  const Muscle muscle = two_heads();
  const std::vector<LineShare> shares = line_shares(muscle.action_line, 5 * 12 + 2);
  ASSERT_EQ(shares.size(), 62u);
  for (Index v = 0; v < 60; ++v) {
    const LineShare& share = shares[static_cast<std::size_t>(v)];
    const SheetCorner corner = sheet_corner(12, 2, 2, static_cast<Real>(v % 12));
    EXPECT_EQ(share.section, v / 12);
    EXPECT_EQ(share.line, corner.head);
    EXPECT_NEAR(share.next, corner.next, 1e-15);
  }
  EXPECT_EQ(shares[60].section, 0);
  EXPECT_EQ(shares[61].section, 4);
  for (const std::size_t end : {60u, 61u}) EXPECT_NEAR(shares[end].next, 0.75, 1e-12) << "between corners 2 and 3";
}

TEST(LineShares, of_a_muscle_with_one_line_are_sections_alone) {
  ActionLine line;
  line.rays = 6;
  for (const LineShare& share : line_shares(line, 3 * 6 + 2)) {
    EXPECT_EQ(share.line, 0u);
    EXPECT_EQ(share.next, 0);
  }
  EXPECT_EQ(line_shares(line, 20)[13].section, 2);
}

TEST(LineShares, of_lines_with_few_corners_are_sections_as_well) {
  for (const Index rays : {3, 4}) {
    ActionLine line;
    line.rays = rays;
    const std::vector<LineShare> shares = line_shares(line, 3 * rays + 2);
    for (Index v = 0; v < 3 * rays; ++v) EXPECT_EQ(shares[static_cast<std::size_t>(v)].section, v / rays) << rays;
    EXPECT_EQ(shares[static_cast<std::size_t>(3 * rays)].section, 0);
    EXPECT_EQ(shares[static_cast<std::size_t>(3 * rays) + 1].section, 2) << "the last of three";
  }
}

TEST(LineShares, of_any_point_are_those_of_the_nearest_place_between_lines) {
  std::vector<Points> centers;
  for (const Real x : {0.0, 0.02, 0.05}) {
    Points line(3, 3);
    line << x, x, x, 0, 0, 0, 0, 0.1, 0.2;
    centers.push_back(line);
  }
  const auto expect = [&](const Vec3& p, Index section, std::size_t line, Real next) {
    const LineShare share = nearest_share(centers, p);
    EXPECT_EQ(share.section, section) << p.transpose();
    EXPECT_EQ(share.line, line) << p.transpose();
    EXPECT_NEAR(share.next, next, 1e-12) << p.transpose();
  };
  expect({0.005, 0.01, 0.04}, 0, 0, 0.25);
  expect({-0.01, 0, 0.11}, 1, 0, 0);
  expect({0.035, -0.02, 0.19}, 2, 1, 0.5);
  expect({0.07, 0, 0.2}, 2, 1, 1);
  EXPECT_EQ(nearest_share({centers[1]}, Vec3(1, 1, 0.19)).section, 2);
  EXPECT_EQ(nearest_share({centers[1]}, Vec3(1, 1, 0.19)).next, 0);
  EXPECT_EQ(nearest_share({centers[1], centers[1]}, Vec3(1, 1, 0.19)).next, 0) << "lines that coincide";
}

TEST(InTendons, is_what_all_lines_that_carry_it_have_in_their_tendons) {
  Muscle muscle = two_heads();
  muscle.action_line.heads[1].tendon = 0.06;
  muscle.surface.vertices = Points::Zero(3, 62);
  const std::vector<LineSections> lines = carrying_lines(muscle);
  ASSERT_EQ(lines.size(), 2u);
  // Sections at 0, 25, 50, 75 and 100 mm: the first head's tendon begins at 75, the second's at 40 mm.
  const auto in_tendon = [&](Index section, std::size_t line, Real next) {
    return in_tendons(lines, {LineShare{section, line, next}})[0] != 0;
  };
  const bool first[] = {false, false, false, true, true}, second[] = {false, false, true, true, true};
  for (Index k = 0; k < 5; ++k) {
    EXPECT_EQ(in_tendon(k, 0, 0), first[k]) << k;
    EXPECT_EQ(in_tendon(k, 0, 1), second[k]) << k;
    EXPECT_EQ(in_tendon(k, 0, 0.5), first[k] && second[k]) << k;
  }
  EXPECT_TRUE(in_tendons(Muscle()).empty()) << "no line, no tendon";
}

TEST(InTendons, vertices_of_a_copy_are_judged_by_the_nearest_section) {
  Muscle muscle = two_heads();
  muscle.surface.vertices.resize(3, 3);
  muscle.surface.vertices << 0.001, 0.01, 0.019, 0.004, 0.004, 0.004, 0.02, 0.07, 0.099;
  const std::vector<char> found = in_tendons(muscle);
  EXPECT_EQ(found, (std::vector<char>{0, 1, 1}));
}

}  // namespace gracilis
