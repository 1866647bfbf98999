#include <gracilis/view/charts/line_chart.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gracilis {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

static int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(LineChart, draws_a_line_per_series_and_names_those_with_a_name_in_words) {
  const LineChart chart = {
      "a < b", "x", "y", {{"first", {0, 1}, {2, 3}}, {"second_line", {0, 1}, {3, 4}}, {"", {0, 1}, {1, 1}}}};
  const std::string svg = to_svg(chart);
  EXPECT_EQ(count(svg, "<polyline"), 3);
  EXPECT_THAT(svg, HasSubstr("a &lt; b"));
  EXPECT_THAT(svg, HasSubstr(">second line</text>"));
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
}

TEST(LineChart, named_lines_of_one_color_are_told_apart_by_their_dashes) {
  const Color red(1, 0, 0), blue(0, 0, 1);
  const std::string svg = to_svg({"",
                                  "",
                                  "",
                                  {{"first", {0, 1}, {2, 3}, red},
                                   {"", {0, 1}, {2, 2}, red},
                                   {"other", {0, 1}, {1, 3}, blue},
                                   {"second", {0, 1}, {3, 4}, red},
                                   {"third", {0, 1}, {4, 4}, red}}});
  EXPECT_EQ(count(svg, "stroke-dasharray"), 4) << "two lines, and two in the legend";
  EXPECT_EQ(count(svg, "stroke-dasharray=\"7 3\""), 2);
}

TEST(LineChart, draws_dots_in_place_of_a_line) {
  const std::string svg = to_svg({"", "", "", {{"a", {0, 1, 2}, {0, std::nan(""), 2}, Color::Zero(), 1, 3}}});
  EXPECT_EQ(count(svg, "<circle"), 2);
  EXPECT_EQ(count(svg, "<polyline"), 0);
}

TEST(LineChart, breaks_a_line_where_a_value_is_not_finite_and_draws_none_of_nothing) {
  const Real nan = std::numeric_limits<Real>::quiet_NaN();
  EXPECT_EQ(count(to_svg({"", "", "", {{"", {0, 1, 2, 3, 4}, {0, 1, nan, 1, 0}}}}), "<polyline"), 2);
  const std::string empty = to_svg({"nothing", "", "", {}});
  EXPECT_EQ(count(empty, "<polyline"), 0);
  EXPECT_THAT(empty, Not(HasSubstr("nan")));
}

TEST(AxisTicks, are_round_numbers_within_the_range) {
  EXPECT_THAT(axis_ticks(0, 90, 10), ElementsAre(0, 10, 20, 30, 40, 50, 60, 70, 80, 90));
  EXPECT_THAT(axis_ticks(-0.4, 0.4, 4),
              ElementsAre(testing::DoubleNear(-0.4, 1e-12), testing::DoubleNear(-0.2, 1e-12), 0,
                          testing::DoubleNear(0.2, 1e-12), testing::DoubleNear(0.4, 1e-12)));
}

TEST(AxisTicks, of_a_range_near_rounding_or_without_end_are_few) {
  for (const auto& [low, high] : {std::pair{0.3, 0.3}, std::pair{0.3, 0.3 + 1e-16}, std::pair{1e9, 1e9 + 1e-7},
                                  std::pair{1.0, 1.0 + 2e-12}, std::pair{0.0, 1e-320}, std::pair{-1e300, 1e308}}) {
    EXPECT_GE(axis_ticks(low, high, 10).size(), 1u) << low << " " << high;
    EXPECT_LE(axis_ticks(low, high, 10).size(), 22u) << low << " " << high;
  }
}

}  // namespace gracilis
