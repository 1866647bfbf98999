#include <gracilis/anatomy/fibers/aponeurosis_guides.hpp>
#include <gracilis/anatomy/fibers/guide_tracts.hpp>
#include <gracilis/geometry/measures.hpp>

#include "anatomy/muscles_for_tests.hpp"

#include <pennate_muscles.hpp>
#include <shapes.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace gracilis {

TEST(GuideTracts, samples_of_an_arc_are_its_tangents) {
  const TriangleMesh block = shapes::box({-0.05, -0.05, -0.01}, {0.05, 0.05, 0.01});
  const SolidGrid grid(block, SignedDistance(block), {}, 2000);
  Points arc(3, 49);
  for (Index i = 0; i < arc.cols(); ++i) {
    const Real angle = 0.03 * i;
    arc.col(i) = 0.03 * Vec3(std::cos(angle), std::sin(angle), 0);
  }
  const std::vector<DirectionSample> samples = samples_of_tracts(grid, join({arc}));
  ASSERT_EQ(samples.size(), 13u);
  for (const DirectionSample& sample : samples) {
    // What is averaged lies evenly on both sides of the place. Chords of the arc stand in for it.
    EXPECT_NEAR(sample.direction.dot(sample.place.normalized()), 0, 1e-3);
    EXPECT_GT(sample.direction.dot(Vec3(-sample.place.y(), sample.place.x(), 0)), 0) << "along the tract";
    EXPECT_NEAR(sample.direction.norm(), 1, 1e-12);
    EXPECT_NEAR(sample.weight, polyline_length(arc) / 24, 1e-5);
  }
}

TEST(GuideTracts, a_field_grows_by_its_slope_over_a_step) {
  const TriangleMesh block = shapes::box({-0.05, -0.05, -0.01}, {0.05, 0.05, 0.01});
  const SolidGrid grid(block, SignedDistance(block), {}, 2000);
  const Eigen::VectorXd field = (Eigen::RowVector3d(3, -2, 5) * grid.nodes()).transpose();
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(0.031, -0.024, 0.004)})
    EXPECT_LT((field_growth(grid, field, p) - grid.step() * Vec3(3, -2, 5)).norm(), 1e-12);
  EXPECT_TRUE(field_growth(grid, field, Vec3(1, 0, 0)).isZero());
}

TEST(GuideTracts, are_turned_around_as_wholes_where_they_run_against_the_field) {
  const TriangleMesh block = shapes::box({-0.05, -0.05, -0.01}, {0.05, 0.05, 0.01});
  const SolidGrid grid(block, SignedDistance(block), {}, 2000);
  const Eigen::VectorXd field = grid.nodes().row(0).transpose();
  const Vec3 up = Vec3::UnitX(), place(0.01, 0.01, 0);
  // The second tract runs against the field by weight, though most of its samples do not.
  std::vector<DirectionSample> samples = {{place, up, 1, 0}, {place, -up, 5, 1}, {place, up, 1, 1}, {place, up, 1, 1}};
  turn_along(grid, field, samples);
  EXPECT_EQ(samples[0].direction, up);
  EXPECT_EQ(samples[1].direction, up);
  EXPECT_EQ(samples[2].direction, -up);
  EXPECT_EQ(samples[3].direction, -up);
}

TEST(GuideTracts, tracts_outside_and_points_say_nothing) {
  const TriangleMesh block = shapes::box({-0.05, -0.05, -0.01}, {0.05, 0.05, 0.01});
  const SolidGrid grid(block, SignedDistance(block), {}, 2000);
  Points away(3, 2), point(3, 2), leaving(3, 2);
  away << 0, 0.01, 0, 0, 0.05, 0.05;
  point << 0.01, 0.01, 0, 0, 0, 0;
  leaving << 0, 0.1, 0, 0, 0, 0;
  EXPECT_TRUE(samples_of_tracts(grid, join({away, point})).empty());
  const std::vector<DirectionSample> samples = samples_of_tracts(grid, join({point, leaving}));
  ASSERT_FALSE(samples.empty());
  EXPECT_LT(samples.size(), 9u);
  for (const DirectionSample& sample : samples) {
    EXPECT_LT(sample.place.x(), 0.05 + grid.step());
    EXPECT_EQ(sample.tract, 1);
  }
}

TEST(GuideTracts, between_origin_and_insertion_of_a_tube_the_field_grows_evenly_along_it) {
  const Muscle tube = tube_muscle();
  const SolidGrid grid(tube.surface, SignedDistance(tube.surface), {}, 2000);
  const Eigen::VectorXd field = inner_origin_to_insertion(grid, tube);
  for (Index n = 0; n < grid.count(); ++n) {
    if (grid.depths()[static_cast<std::size_t>(n)] < grid.step()) continue;
    EXPECT_NEAR(field[n], grid.nodes()(2, n) / 0.2, 0.03) << grid.nodes().col(n).transpose();
  }
}

TEST(AponeurosisGuides, lines_between_the_ends_of_a_tube_run_along_it) {
  const Muscle tube = tube_muscle();
  const Polylines lines = lines_between_ends(tube, 50);
  ASSERT_EQ(lines.count(), 50);
  for (Index i = 0; i < 50; ++i) {
    const Points line = lines.line(i);
    EXPECT_NEAR(line(2, 0), 0, 1e-9);
    EXPECT_NEAR(line(2, 1), 0.2, 1e-9);
    EXPECT_LT((line.col(0) - line.col(1)).head<2>().norm(), 0.004);
  }
  EXPECT_FALSE(attachments_are_spread(tube));
}

TEST(AponeurosisGuides, aponeuroses_are_taken_by_their_end_or_all) {
  const Muscle muscle = PennateMuscle(true, 0).with_aponeuroses();
  const Index one = muscle.aponeuroses[0].surface.face_count();
  EXPECT_EQ(aponeuroses_of(muscle).face_count(), 3 * one);
  EXPECT_EQ(aponeuroses_of(muscle, AttachmentEnd::origin).face_count(), 2 * one);
  EXPECT_EQ(aponeuroses_of(muscle, AttachmentEnd::insertion).face_count(), one);
  EXPECT_EQ(aponeuroses_of(PennateMuscle(true, 0).muscle()).face_count(), 0);
}

TEST(AponeurosisGuides, directions_lie_at_the_pennation_to_the_line_of_action_from_the_origins_side) {
  // A slab 10 mm thick: the origin at its left end's lower edge, the insertion at its right end's upper one.
  Muscle muscle;
  muscle.surface = box_mesh({0, 0, 0}, {0.12, 0.05, 0.01}, {24, 10, 2});
  muscle.attachments.resize(2);
  muscle.attachments[1].end = AttachmentEnd::insertion;
  for (Index v = 0; v < muscle.surface.vertex_count(); ++v) {
    const Vec3 p = muscle.surface.vertices.col(v);
    if (p.x() < 1e-9 && p.z() < 0.006) muscle.attachments[0].vertices.push_back(v);
    if (p.x() > 0.12 - 1e-9 && p.z() > 0.004) muscle.attachments[1].vertices.push_back(v);
  }
  muscle.fibers.pennation = radians(25);
  const SolidGrid grid(muscle.surface, SignedDistance(muscle.surface), {}, 2000);
  for (const bool is_swapped : {false, true}) {
    if (is_swapped) std::swap(muscle.attachments[0].end, muscle.attachments[1].end);
    const std::vector<DirectionSample> samples = pennate_directions(grid, muscle);
    ASSERT_GT(samples.size(), 1000u);
    const Eigen::VectorXd field = inner_origin_to_insertion(grid, muscle);
    for (const DirectionSample& sample : samples) {
      const Vec3 along = field_growth(grid, field, sample.place).normalized();
      EXPECT_NEAR(sample.direction.norm(), 1, 1e-12);
      EXPECT_NEAR(sample.direction.dot(along), std::cos(radians(25)), 1e-9);
      const Vec3 across = sample.direction - sample.direction.dot(along) * along;
      EXPECT_GT((is_swapped ? -1 : 1) * across.z(), 0.2) << "from one broad side to the other";
    }
  }
}

}  // namespace gracilis
