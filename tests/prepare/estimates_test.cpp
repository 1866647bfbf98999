#include <gracilis/core/errors.hpp>
#include <gracilis/prepare/cgal.hpp>
#include <gracilis/prepare/prepare_surfaces.hpp>
#include <gracilis/prepare/time_limit.hpp>

#include "shapes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <ctime>
#include <functional>
#include <limits>
#include <thread>

namespace gracilis {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string refused(const std::vector<NamedSurface>& muscles, const std::vector<NamedSurface>& bones = {},
                    const PrepareSettings& settings = {}) {
  try {
    prepare_surfaces(muscles, bones, settings, [](const std::string&) {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "no problem";
}

TriangleMesh ball(const Vec3& center = Vec3::Zero(), Real radius = 0.02) { return shapes::sphere(center, radius, 2); }

}  // namespace

TEST(PreparationEstimates, a_vertex_far_away_is_told_of_before_any_work) {
  TriangleMesh far = ball();
  far.vertices(0, 5) = 2e9;
  EXPECT_THAT(refused({{"psoas", far}}), HasSubstr("psoas: would have about"));
  far.vertices(0, 5) = std::numeric_limits<Real>::quiet_NaN();
  EXPECT_THAT(refused({{"psoas", far}}), HasSubstr("psoas: has a coordinate that is not finite"));
}

TEST(PreparationEstimates, an_edge_length_that_is_too_small_is_named) {
  PrepareSettings fine;
  fine.edge_length = 1e-6;
  EXPECT_THAT(refused({{"psoas", ball()}}, {}, fine), HasSubstr("raise 'edge_length'"));
}

TEST(PreparationEstimates, a_surface_that_would_take_too_long_is_told_of_before_and_may_have_more_time) {
  PrepareSettings hasty;
  hasty.edge_length = 0.0002;
  hasty.time_limit = 10;
  EXPECT_THAT(refused({{"psoas", ball()}}, {}, hasty), HasSubstr("psoas: would take about"));
  hasty.edge_length = 0.003;
  EXPECT_EQ(refused({{"psoas", ball()}}, {}, hasty), "no problem");
}

TEST(PreparationEstimates, time_counts_while_there_is_a_processor) {
  const TimeLimit limit(0.03);
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  EXPECT_FALSE(limit.is_over()) << "nothing was done meanwhile";
  const auto begin = std::chrono::steady_clock::now();
  while (!limit.is_over()) ASSERT_LT(std::chrono::steady_clock::now() - begin, std::chrono::minutes(1));
}

TEST(PreparationEstimates, time_counts_while_millions_of_edges_are_split) {
  const std::clock_t begin = std::clock();
  EXPECT_THROW(remesh_isotropic(ball(), 0.00005, 1, TimeLimit(0.2)), OutOfTime);
  EXPECT_LT(Real(std::clock() - begin) / CLOCKS_PER_SEC, 3);
}

TEST(PreparationEstimates, everything_that_is_wrong_is_told_at_once) {
  TriangleMesh flat = ball();
  flat.vertices.row(2).setZero();
  EXPECT_THAT(refused({{"psoas", flat}, {"iliacus", ball()}, {"sartorius", flat}}),
              AllOf(HasSubstr("psoas: encloses no volume"), HasSubstr("sartorius: encloses no volume")));
}

TEST(PreparationEstimates, surfaces_that_lie_in_each_other_are_named) {
  EXPECT_THAT(refused({{"psoas", ball()}, {"iliacus", ball(Vec3::Zero(), 0.03)}}),
              HasSubstr("psoas: lies for the most part (100 %) in iliacus"));
  EXPECT_THAT(refused({{"psoas", ball()}}, {{"femur", ball(Vec3(0.001, 0, 0), 0.05)}}),
              HasSubstr("psoas: lies for the most part (100 %) in femur"));
}

TEST(PreparationEstimates, what_can_be_prepared_is_where_the_rest_is_to_be_left_out) {
  TriangleMesh flat = ball(), far = ball();
  flat.vertices.row(2).setZero();
  far.vertices(0, 5) = 2e9;
  const std::vector<NamedSurface> muscles = {{"far", far},
                                             {"psoas", ball()},
                                             {"flat", flat},
                                             {"iliacus", ball(Vec3::Zero(), 0.03)},
                                             {"sartorius", ball(Vec3(0.2, 0, 0))}};
  std::vector<Problem> problems;
  const auto nothing = [](const std::string&) {};
  const PreparedSurfaces prepared = prepare_possible(muscles, {}, {}, nothing, problems);
  ASSERT_EQ(prepared.muscles.size(), 2u);
  EXPECT_EQ(prepared.report.muscles[0].name, "iliacus");
  EXPECT_EQ(prepared.report.muscles[1].name, "sartorius");
  ASSERT_EQ(problems.size(), 3u);
  EXPECT_THAT(to_string(problems[0]), HasSubstr("far: would have about"));
  EXPECT_THAT(to_string(problems[1]), HasSubstr("flat: encloses no volume"));
  EXPECT_THAT(to_string(problems[2]), HasSubstr("psoas: lies for the most part"));
  far.vertices(0, 5) = std::numeric_limits<Real>::quiet_NaN();
  EXPECT_THROW(prepare_possible(muscles, {{"femur", far}}, {}, nothing, problems), InputError);
}

TEST(PreparationEstimates, overlaps_that_are_to_stay_are_measured_and_nothing_moves) {
  PrepareSettings settings;
  settings.keep_overlaps = true;
  const std::vector<NamedSurface> muscles = {{"psoas", ball()}, {"iliacus", ball(Vec3(0.035, 0, 0))}};
  const PreparationReport report = prepare_surfaces(muscles, {}, settings, [](const std::string&) {}).report;
  for (const PreparedMuscleReport& muscle : report.muscles) EXPECT_EQ(muscle.vertices_moved, 0);
  ASSERT_EQ(report.pairs.size(), 1u);
  EXPECT_GT(report.pairs[0].intersections_after, 0);
  EXPECT_GT(report.largest_shortfall, 0.002);
  EXPECT_TRUE(report.pulled_apart);  // as far as was asked for
  EXPECT_EQ(refused({{"psoas", ball()}, {"iliacus", ball(Vec3::Zero(), 0.03)}}, {}, settings), "no problem");
}

TEST(PreparationEstimates, muscles_that_overlap_a_little_are_prepared) {
  EXPECT_EQ(refused({{"psoas", ball()}, {"iliacus", ball(Vec3(0.039, 0, 0))}}), "no problem");
}

}  // namespace gracilis
