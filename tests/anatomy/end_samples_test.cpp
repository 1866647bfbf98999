#include <gracilis/anatomy/attachments/attachment_samples.hpp>
#include <gracilis/anatomy/fibers/aponeurosis_guides.hpp>
#include <gracilis/anatomy/fibers/fiber_containment.hpp>
#include <gracilis/anatomy/fibers/inner_fibers.hpp>
#include <gracilis/anatomy/fibers/traced_fibers.hpp>

#include "anatomy/muscles_for_tests.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gracilis {
namespace {

/// A flat rectangle in z = 1 m, so many cells along x and y; `stretch` moves the columns.
TriangleMesh plate(
    Real width, Real height, Index columns, Index rows,
    const std::function<Real(Real)>& stretch = [](Real u) { return u; }) {
  std::vector<Vec3> vertices;
  std::vector<Eigen::Vector3i> faces;
  for (Index j = 0; j <= rows; ++j)
    for (Index i = 0; i <= columns; ++i)
      vertices.emplace_back(width * stretch(static_cast<Real>(i) / columns), height * j / rows, 1);
  for (Index j = 0; j < rows; ++j)
    for (Index i = 0; i < columns; ++i) {
      const Index a = j * (columns + 1) + i, c = a + columns + 1;
      faces.emplace_back(a, a + 1, c);
      faces.emplace_back(a + 1, c + 1, c);
    }
  return shapes::mesh_of(vertices, faces);
}

/// Strips of vertices as origin (z = 0) and insertion (z = h), each of the width `along`, the second shifted by s.
Muscle two_strips(Real along, Real s, Real h) {
  TriangleMesh lower = plate(along, 0.004, 60, 4), upper = lower;
  lower.vertices.row(2).setZero();
  upper.vertices.row(2).setConstant(h);
  upper.vertices.row(0).array() += s;
  Muscle muscle;
  muscle.surface = shapes::both(lower, upper);
  muscle.attachments.resize(2);
  muscle.attachments[1].end = AttachmentEnd::insertion;
  for (Index v = 0; v < lower.vertex_count(); ++v) {
    muscle.attachments[0].vertices.push_back(v);
    muscle.attachments[1].vertices.push_back(lower.vertex_count() + v);
  }
  return muscle;
}

}  // namespace

TEST(SurfacePoints, lie_as_densely_everywhere_whatever_the_triangles) {
  // Nine tenths of the columns lie in the first half.
  const TriangleMesh uneven = plate(2, 1, 40, 10, [](Real u) { return u < 0.9 ? u / 1.8 : 0.5 + (u - 0.9) * 5; });
  const Points points = surface_points(uneven, 128);
  ASSERT_EQ(points.cols(), 128);
  std::array<int, 8> counts{};
  for (Index i = 0; i < 128; ++i) {
    EXPECT_NEAR(points(2, i), 1, 1e-12);
    EXPECT_GE(points(0, i), 0);
    EXPECT_LE(points(0, i), 2);
    EXPECT_GE(points(1, i), 0);
    EXPECT_LE(points(1, i), 1);
    const auto cell = static_cast<std::size_t>(std::min(points(0, i) / 0.5, 3.999)) +
                      4 * static_cast<std::size_t>(std::min(points(1, i) / 0.5, 1.999));
    ++counts[cell];
  }
  for (const int count : counts) EXPECT_NEAR(count, 16, 2);
  EXPECT_EQ(points, surface_points(uneven, 128)) << "always the same";
}

TEST(SurfacePoints, one_lies_in_the_middle_and_those_of_a_strip_in_equal_parts_of_it) {
  const Points one = surface_points(plate(8, 1, 16, 2), 1);
  EXPECT_LT((one.col(0) - Vec3(4, 0.5, 1)).norm(), 0.8) << "the nearest of twenty";
  Points eight = surface_points(plate(8, 1, 16, 2), 8);
  ASSERT_EQ(eight.cols(), 8);
  std::vector<Real> places(eight.row(0).begin(), eight.row(0).end());
  EXPECT_TRUE(std::is_sorted(places.begin(), places.end())) << "part by part";
  for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(places[i], static_cast<Real>(i) + 0.5, 0.4);
  EXPECT_EQ(surface_points(plate(1, 1, 2, 2), 0).cols(), 0);
}

TEST(SurfacePoints, of_a_triangle_lie_in_it_and_about_its_centroid) {
  const TriangleMesh triangle = shapes::mesh_of({{3, 1, 2}, {4, 1, 2}, {3, 3, 2.5}}, {{0, 1, 2}});
  const Points points = surface_points(triangle, 200);
  Vec3 mean = Vec3::Zero();
  for (Index i = 0; i < 200; ++i) {
    const Real u = points(0, i) - 3, v = (points(1, i) - 1) / 2;
    EXPECT_GE(std::min({u, v, 1 - u - v}), -1e-12);
    EXPECT_NEAR(points(2, i), 2 + 0.5 * v, 1e-12);
    mean += points.col(i) / 200;
  }
  EXPECT_LT((mean - Vec3(10, 5, 6.5) / 3).norm(), 0.02);
}

TEST(AttachmentSamples, of_an_end_that_is_not_there_are_none) {
  Muscle muscle = tube_muscle();
  muscle.attachments.pop_back();
  EXPECT_EQ(attachment_samples(muscle, AttachmentEnd::insertion, 5).cols(), 0);
  EXPECT_TRUE(attachment_center(muscle, AttachmentEnd::insertion).isZero());
}

TEST(AttachmentSamples, the_middle_is_that_of_the_area_or_of_single_vertices) {
  Muscle muscle;
  muscle.surface = plate(2, 1, 40, 10, [](Real u) { return u * u; });
  muscle.attachments.resize(1);
  for (Index v = 0; v < muscle.surface.vertex_count(); ++v) muscle.attachments[0].vertices.push_back(v);
  EXPECT_LT((attachment_center(muscle, AttachmentEnd::origin) - Vec3(1, 0.5, 1)).norm(), 0.01);
  muscle.attachments[0].vertices = {0, 40, 41 * 10};
  EXPECT_LT((attachment_center(muscle, AttachmentEnd::origin) - Vec3(2.0 / 3, 1.0 / 3, 1)).norm(), 1e-12);
  const Points four = attachment_samples(muscle, AttachmentEnd::origin, 4);
  for (Index i = 0; i < 4; ++i)
    EXPECT_LT((muscle.surface.vertices(Eigen::all, muscle.attachments[0].vertices).colwise() - four.col(i))
                  .colwise()
                  .norm()
                  .minCoeff(),
              1e-15);
}

TEST(AponeurosisGuides, no_two_lines_would_be_shorter_the_other_way_round) {
  const Polylines lines = lines_between_ends(two_strips(0.06, 0.02, 0.02), 60);
  ASSERT_EQ(lines.count(), 60);
  for (Index i = 0; i < 60; ++i)
    for (Index j = 0; j < i; ++j) {
      const Points a = lines.line(i), b = lines.line(j);
      EXPECT_LE((a.col(1) - a.col(0)).squaredNorm() + (b.col(1) - b.col(0)).squaredNorm(),
                (b.col(1) - a.col(0)).squaredNorm() + (a.col(1) - b.col(0)).squaredNorm() + 1e-12);
    }
}

TEST(AponeurosisGuides, attachments_are_spread_from_half_of_a_fibers_length_of_overlap_on) {
  // Lines lead by s along the strips and by h = s up: of strips of the length L nine tenths of the origin reach to
  // 0.9 L s / l along them, a tenth of the insertion to l + 0.1 L s / l: they overlap by half of l from L = 3.75 s on.
  const Real s = 0.01;
  EXPECT_TRUE(attachments_are_spread(two_strips(4.1 * s, s, s)));
  EXPECT_FALSE(attachments_are_spread(two_strips(3.4 * s, s, s)));
}

TEST(SmoothInside, with_limits_points_go_no_further_than_these_allow_from_where_they_were) {
  const TriangleMesh ball = shapes::sphere(Vec3::Zero(), 1, 3);
  const SignedDistance distance(ball);
  Points line(3, 9);
  for (Index i = 0; i < 9; ++i) line.col(i) = Vec3(0.1 * i - 0.4, i % 2 == 0 ? 0.1 : -0.1, i % 2 == 0 ? -0.1 : 0.1);
  for (const Real reach : {0.01, 0.03}) {
    // Along y as far as that, along z twice as far, along x as far as one likes.
    const Eigen::Matrix3d limit = Vec3(0, 1, 0.25).asDiagonal() * Eigen::Matrix3d::Identity() / (reach * reach);
    const std::vector<Eigen::Matrix3d> limits(9, limit);
    Points smooth = line;
    smooth_inside(ball, distance, 1e-4, 20, smooth, limits);
    EXPECT_EQ(smooth.col(0), line.col(0));
    EXPECT_EQ(smooth.col(8), line.col(8));
    for (Index i = 1; i < 8; ++i) {
      const Vec3 way = smooth.col(i) - line.col(i);
      EXPECT_NEAR(way.dot(limit * way), 1, 1e-9) << "all would go further";
      EXPECT_GT(-way.y() * line(1, i), 0) << "towards the middle";
    }
  }
  // Each point by its own limit: the fourth alone may go.
  std::vector<Eigen::Matrix3d> limits(9, 1e12 * Eigen::Matrix3d::Identity());
  limits[3] = Eigen::Matrix3d::Zero();
  Points one = line;
  smooth_inside(ball, distance, 1e-4, 1, one, limits);
  for (Index i = 1; i < 8; ++i) EXPECT_NEAR((one.col(i) - line.col(i)).norm(), i == 3 ? std::sqrt(0.02) : 1e-6, 1e-9);
}

TEST(OriginToInsertion, grows_evenly_along_a_tube_from_nil_to_one) {
  const Muscle muscle = tube_muscle();
  const Eigen::VectorXd field = origin_to_insertion(muscle);
  for (Index v = 0; v < muscle.surface.vertex_count(); ++v)
    EXPECT_NEAR(field[v], muscle.surface.vertices(2, v) / 0.2, 1e-6) << v;
}

TEST(CutIntoSections, of_a_cone_has_equal_areas_between_levels) {
  Muscle muscle = cone_muscle();
  muscle.fibers.smoothing_reach = unlimited_smoothing;  // so that nothing is put between them
  const int count = 16;
  const Sections sections = cut_into_sections(muscle, count);
  ASSERT_EQ(static_cast<int>(sections.maps.size()), count);
  for (int k = 0; k < count; ++k) {
    // Its width falls from 1 to a half over 0.2 m: up to z there is z - 1.25 z² of 0.15.
    const Real z = 0.2 * sections.shares[static_cast<std::size_t>(k)];
    EXPECT_NEAR((z - 1.25 * z * z) / 0.15, (k + 0.75) / (count + 0.5), 0.02) << k;
  }
}

TEST(EvenlyTraced, short_and_long_parts_of_one_section_get_as_many_fibers) {
  // Two blocks beside each other, 20 and 50 mm high.
  const TriangleMesh blocks = shapes::both(shapes::box({-0.021, -0.01, 0}, {-0.001, 0.01, 0.02}),
                                           shapes::box({0.001, -0.01, 0}, {0.021, 0.01, 0.05}));
  const FiberRoom room(blocks, {}, 4000);
  Points up = Points::Zero(3, room.grid().count());
  up.row(2).setOnes();
  const std::vector<Points> lines = evenly_traced(room, FiberField(room.grid(), up, 0.003), 32);
  ASSERT_EQ(lines.size(), 32u);
  int in_short = 0;
  for (const Points& line : lines) {
    in_short += line(0, 0) < 0;
    EXPECT_NEAR(polyline_length(line), line(0, 0) < 0 ? 0.02 : 0.05, 1e-6);
  }
  EXPECT_NEAR(in_short, 16, 1);
}

}  // namespace gracilis
