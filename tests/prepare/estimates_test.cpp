#include <gracilis/core/errors.hpp>
#include <gracilis/prepare/prepare_surfaces.hpp>

#include "shapes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

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

TEST(PreparationEstimates, muscles_that_overlap_a_little_are_prepared) {
  EXPECT_EQ(refused({{"psoas", ball()}, {"iliacus", ball(Vec3(0.039, 0, 0))}}), "no problem");
}

}  // namespace gracilis
