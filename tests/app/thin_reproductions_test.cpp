#include "app/reproduction.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

/// What thin passes of the reproductions leave behind.
namespace gracilis {
namespace {

/// The value beside the published one whose quantity begins so.
Real ours(const Reproduction& made, const std::string& quantity) {
  for (const Reproduction::Row& row : made.rows())
    if (row.text("quantity").rfind(quantity, 0) == 0 && !row.text("ours").empty()) return row.number("ours");
  ADD_FAILURE() << "nothing made of " << quantity;
  return 0;
}

TEST(LacleReproduction, the_thin_pass_has_the_shape_of_the_published_results) {
  if (!Reproduction::has_data("opensim") || !Reproduction::has_data("leg"))
    GTEST_SKIP() << "the walking model and the leg are not here: set GRACILIS_DATA";
  const Reproduction made("--thin", "lacle-2014", "results.csv");
  ASSERT_EQ(made.exit_code, 0);
  // Table 3.3, by import.
  EXPECT_NEAR(ours(made, "half of tibialis anterior's slack length"), 0.1114, 1e-4);
  EXPECT_NEAR(ours(made, "half of it in a skeleton"), 0.107, 5e-4);
  // Table 5.1: as many vertices as eq. 3.19 says of as many via points: with six corners 12 for each and for each
  // muscle 12 more and two ends.
  const Real hexagons = ours(made, "vertices of 48 muscles, LSS 0, 6"),
             dodecagons = ours(made, "vertices of 48 muscles, LSS 0, 12");
  EXPECT_NEAR((hexagons - 2 * 48) * 2, dodecagons - 2 * 48, 0);
  const Real sections = (hexagons - 2 * 48) / 6;
  EXPECT_EQ(ours(made, "vertices of 48 muscles, LSS 1, 6"), 6 * (2 * (sections - 48) + 48) + 2 * 48);
  // Figure 3.15.
  EXPECT_EQ(ours(made, "slices of the muscles' surfaces"), 22 * 3);
  EXPECT_GT(ours(made, "of them with an isoperimetric quotient above 0.5"), 20);
  // Table 5.2: more rays find more centers.
  const Real few = ours(made, "centers outside, LSS 1, CSS 1, 6"),
             many = ours(made, "centers outside, LSS 1, CSS 6, 12");
  EXPECT_GT(few, many);
  EXPECT_LE(many, 0.1 * ours(made, "sections in all, LSS 1"));
  // Ten muscles and 25 transversals, in real time, and what does not come free is told.
  EXPECT_GT(ours(made, "frames of 10 muscles with 25 transversals"), 60);
  const auto rounds = made.curve("figure_5_6", "rounds");
  ASSERT_GE(rounds.size(), 3U);
  for (const auto& [frame, count] : rounds) EXPECT_LE(count, 20) << frame;
  EXPECT_THAT(made.page(), testing::HasSubstr("not free"));
}

TEST(JanakReproduction, springs_come_to_rest_and_short_steps_take_longer) {
  if (!Reproduction::has_data("lhdl-hip")) GTEST_SKIP() << "the cadaver is not here: set GRACILIS_DATA";
  const Reproduction made("--thin", "janak-2012", "results.csv");
  ASSERT_EQ(made.exit_code, 0);
  // Figures 5.9 and 5.10: changes of length fall, and by adaptive steps more slowly.
  const auto constant = made.curve("figure_5_9", "0.4"), adaptive = made.curve("figure_5_9", "adaptive");
  ASSERT_EQ(constant.size(), 3U);
  ASSERT_EQ(adaptive.size(), 3U);
  for (std::size_t i = 1; i < 3; ++i) {
    EXPECT_LT(constant[i].second, constant[i - 1].second);
    EXPECT_LT(adaptive[i].second, adaptive[i - 1].second);
    EXPECT_LT(constant[i].second, adaptive[i].second);
  }
  EXPECT_LT(ours(made, "mean adaptive step"), 0.2);
  // Figure 5.18: more particles take longer.
  const auto springs = made.curve("figure_5_17", "springs");
  ASSERT_EQ(springs.size(), 2U);
  EXPECT_GT(springs[1].second, springs[0].second);
}

TEST(HavlicekReproduction, the_preset_has_the_published_parameters_and_fibers_follow_the_femur) {
  const Reproduction made("--thin", "havlicek-2024", "results.csv");
  ASSERT_EQ(made.exit_code, 0);
  int same = 0;
  for (const Reproduction::Row& row : made.rows())
    if (!row.text("ours").empty()) {
      EXPECT_EQ(row.number("ours"), row.number("published")) << row.text("quantity");
      ++same;
    }
  EXPECT_EQ(same, 18);  // all of table B.1 but what is left out
  for (const char* method : {"XPBD, 70 iterations", "PBD, 3 iterations"}) {
    const auto lengths = made.curve("fibers_gluteus_maximus_r", method);
    ASSERT_EQ(lengths.size(), 11U) << method;
    EXPECT_GT(lengths.back().second, 1.01 * lengths.front().second) << method;
    EXPECT_LT(lengths.back().second, 1.15 * lengths.front().second) << method;
  }
}

TEST(CervenkaKohoutReproduction, the_box_s_volume_is_squeezed_out_and_comes_back) {
  const Reproduction made("--thin", "cervenka-kohout-2020", "results.csv");
  ASSERT_EQ(made.exit_code, 0);
  const auto volume = made.curve("volume_error_percent", "box"), edges = made.curve("mean_edge_ratio", "box");
  ASSERT_EQ(volume.size(), 301U);
  ASSERT_EQ(edges.size(), 301U);
  Real least = 0;
  for (const auto& [frame, error] : volume) least = std::min(least, error);
  EXPECT_LT(least, -5);  // figure 11: large
  EXPECT_NEAR(volume.back().second, 0, 1);
  EXPECT_EQ(edges.front().second, 1);
  EXPECT_GT(edges[95].second, edges.back().second);
}

}  // namespace
}  // namespace gracilis
