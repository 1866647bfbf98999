#include <gracilis/anatomy/fibers/aponeurosis_guides.hpp>
#include <gracilis/anatomy/fibers/fascicles.hpp>
#include <gracilis/anatomy/fibers/muscle_fibers.hpp>
#include <gracilis/core/parallel.hpp>

#include "anatomy/muscles_for_tests.hpp"

#include <fascicle_measures.hpp>
#include <pennate_muscles.hpp>

#include <gtest/gtest.h>

namespace gracilis {
namespace {

/// Fascicles as they are, but for a tenth at either end: where two sides meet, which one is nearest is chance.
Polylines true_fascicles(const PennateMuscle& muscle) {
  return muscle.fascicles(150, [](const Points& line, std::mt19937&) { return Points(line.middleCols(3, 25)); });
}

Real true_length(const PennateMuscle& muscle) {
  Real sum = 0;
  const Polylines all = muscle.fascicles(150, [](const Points& line, std::mt19937&) { return line; });
  for (const Real length : polyline_lengths(all)) sum += length / all.count();
  return sum;
}

Polylines measured(const PennateMuscle& muscle, Index count) {
  return muscle.fascicles(
      count, [](const Points& line, std::mt19937& chance) { return as_measured(line, 3e-4, 0.1, chance); });
}

void expect_fibers(const PennateMuscle& known, const Muscle& muscle, Real median, Real at_95, Real length_error) {
  const Polylines fibers = fibers_of(muscle);
  ASSERT_EQ(fibers.count(), muscle.fibers.count);
  const FascicleMeasures found = compared(muscle.surface, fibers, true_fascicles(known));
  EXPECT_LT(degrees(found.median_angle), median);
  EXPECT_LT(degrees(found.large_angle), at_95);
  EXPECT_NEAR(found.mean_length / true_length(known), 1, length_error);
  EXPECT_LE(found.farthest_outside, 1e-9);
}

}  // namespace

TEST(Fascicles, along_noisy_tracts_with_outliers_run_like_those_of_a_unipennate_muscle) {
  for (const Real bend : {0.0, 6.0}) {
    const PennateMuscle known(false, bend);
    Muscle muscle = known.muscle();
    muscle.tracts = measured(known, 150);
    expect_fibers(known, muscle, 2, 5, 0.03);
    muscle.tracts = measured(known, 20);
    expect_fibers(known, muscle, 5, 12, 0.05);
  }
}

TEST(Fascicles, end_where_the_two_sides_of_a_bipennate_muscle_meet) {
  for (const Real bend : {0.0, 6.0}) {
    const PennateMuscle known(true, bend);
    Muscle muscle = known.muscle();
    muscle.tracts = measured(known, 400);
    expect_fibers(known, muscle, 1.5, 8, 0.03);
    muscle.tracts = measured(known, 60);
    expect_fibers(known, muscle, 5, 60, 0.15);
  }
}

TEST(Fascicles, between_given_aponeuroses_run_from_one_to_the_other) {
  for (const Real bend : {0.0, 6.0}) {
    const PennateMuscle one(false, bend), two(true, bend);
    expect_fibers(one, one.with_aponeuroses(), 4, 6, 0.02);
    expect_fibers(two, two.with_aponeuroses(), 5, 15, 0.05);
    Muscle muscle = one.with_aponeuroses();
    muscle.fibers.ends = FiberEnds::attachments;
    EXPECT_GT(mean_fiber_length(fibers_of(muscle)), 2 * true_length(one));
  }
}

TEST(Fascicles, lie_at_a_given_pennation_where_only_that_is_known) {
  const PennateMuscle known(false, 6);
  Muscle muscle = known.muscle();
  muscle.fibers.ends = FiberEnds::aponeuroses;
  muscle.fibers.pennation = radians(30);
  expect_fibers(known, muscle, 5, 20, 0.15);
}

TEST(Fascicles, run_from_origin_to_insertion) {
  const PennateMuscle known(false, 0);
  Muscle muscle = known.muscle();
  muscle.tracts = measured(known, 60);
  for (const bool is_turned : {false, true}) {
    if (is_turned)
      for (Attachment& each : muscle.attachments)
        each.end = each.end == AttachmentEnd::origin ? AttachmentEnd::insertion : AttachmentEnd::origin;
    const Polylines fibers = fibers_of(muscle);
    for (Index i = 0; i < fibers.count(); ++i) {
      const Points line = fibers.line(i);
      EXPECT_EQ((line.rightCols(1) - line.leftCols(1))(0) > 0, !is_turned) << "fiber " << i;
    }
  }
}

TEST(Fascicles, are_left_out_where_fibers_run_from_end_to_end) {
  const Muscle tube = tube_muscle();
  EXPECT_FALSE(attachments_are_spread(tube));
  EXPECT_EQ(fascicles_of(tube).count(), 0);
  EXPECT_TRUE(fibers_of(tube).points == attached_fibers_of(tube).points);
}

TEST(Fascicles, are_found_where_attachments_are_spread_as_aponeuroses_are) {
  const PennateMuscle known(false, 6);
  Muscle muscle = known.muscle();
  const Muscle with_sheets = known.with_aponeuroses();
  const NearestTriangle insertion(with_sheets.aponeuroses[0].surface), origin(with_sheets.aponeuroses[1].surface);
  for (Attachment& each : muscle.attachments) {
    each.vertices.clear();
    const NearestTriangle& sheet = each.end == AttachmentEnd::origin ? origin : insertion;
    for (Index v = 0; v < muscle.surface.vertex_count(); ++v)
      if (sheet.query(muscle.surface.vertices.col(v)).distance < 1e-4) each.vertices.push_back(v);
  }
  EXPECT_TRUE(attachments_are_spread(muscle));
  expect_fibers(known, muscle, 4, 8, 0.03);
}

TEST(Fascicles, are_the_same_for_any_number_of_threads) {
  const PennateMuscle known(true, 6);
  Muscle muscle = known.muscle();
  muscle.tracts = measured(known, 60);
  const Polylines all = fibers_of(muscle);
  const ThreadLimit one(1);
  EXPECT_TRUE(fibers_of(muscle).points == all.points);
}

TEST(Fascicles, of_tracts_that_say_nothing_are_the_usual_fibers) {
  const PennateMuscle known(false, 0);
  Muscle muscle = known.muscle();
  const Polylines usual = fibers_of(muscle);
  Points away(3, 2), point(3, 2);
  away << 5, 6, 5, 6, 5, 6;
  point << 0.06, 0.06, 0.007, 0.007, -0.02, -0.02;
  muscle.tracts = join({away, point});
  EXPECT_TRUE(fibers_of(muscle).points == usual.points);
}

}  // namespace gracilis
