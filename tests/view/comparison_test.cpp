#include <gracilis/view/comparison/comparison_page.hpp>

#include "view/browser.hpp"
#include "view/recorded_runs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/test_files.hpp>

#include <cmath>

namespace gracilis {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

std::size_t column(std::string_view key) {
  for (std::size_t c = 0; c < comparison_columns().size(); ++c)
    if (comparison_columns()[c].key == key) return c;
  throw std::runtime_error("no such column");
}

struct TwoRuns {
  TestFolder folder;
  std::vector<ComparedRun> runs;

  TwoRuns() {
    runs.push_back({"one", "bulges", "", FlexingLeg(5).written(folder.path() / "one")});
    runs.push_back({"two", "<b>stops early</b>", "frame 4: <script>", FlexingLeg(4).written(folder.path() / "two")});
  }
};

}  // namespace

TEST(Comparison, rows_tell_the_worst_of_each_run) {
  const TwoRuns two;
  const std::vector<ComparisonRow> rows = comparison_rows(two.runs, {0, 3});
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].method, "one");
  EXPECT_EQ(rows[0].muscle, "gluteus_maximus_r");
  EXPECT_EQ(rows[0].values[column("frames")], 5);
  EXPECT_NEAR(rows[0].values[column("volume_error_percent")], 100 * (std::pow(1.04, 3) - 1), 1e-3);
  EXPECT_NEAR(rows[0].values[column("edge_change_percent")], 4, 1e-3);
  EXPECT_NEAR(rows[0].values[column("fiber_change_percent")], 4, 1e-3);
  EXPECT_EQ(rows[0].values[column("self_cuts")], 0);
  EXPECT_EQ(rows[1].values[column("volume_error_percent")], 0) << "the steady muscle";
  EXPECT_NEAR(rows[2].values[column("volume_error_percent")], 100 * (std::pow(1.03, 3) - 1), 1e-3);
}

TEST(Comparison, moment_arms_are_those_of_the_recorded_lengths) {
  const TwoRuns two;
  const FiberCourse course = fiber_course(two.runs[0].run, "gluteus_maximus_r");
  ASSERT_EQ(course.coordinate.size(), 5u);
  EXPECT_NEAR(course.coordinate[4], 12, 1e-6);
  for (const Real arm : course.moment_arm)
    EXPECT_NEAR(arm, -0.01 * course.length[0] / radians(3), 1e-6) << "lengths grow by 1 % per 3 degrees";
  EXPECT_TRUE(fiber_course(two.runs[0].run, "no_such_muscle").length.empty());
}

TEST(Comparison, a_surface_that_runs_through_itself_is_counted) {
  const TriangleMesh ball = shapes::sphere(Vec3(0, 0, 0), 0.05, 4);
  EXPECT_EQ(new_self_intersections(ball, ball.vertices), 0);
  Points pushed = ball.vertices;
  for (Index v = 0; v < ball.vertex_count(); ++v)  // out at the bottom, and aside, so that nothing meets exactly
    if (pushed.col(v).z() > 0.03 && pushed.col(v).head<2>().norm() < 0.03) pushed.col(v) += Vec3(0.0013, 0.0007, -0.11);
  EXPECT_GT(new_self_intersections(ball, pushed), 10);
}

TEST(Comparison, the_table_has_a_line_per_row_and_empty_cells_for_what_is_not_known) {
  std::vector<Real> values(comparison_columns().size(), 1.25);
  values.back() = std::nan("");
  const std::string text = comparison_csv({{"one", "psoas", values}});
  EXPECT_THAT(text, HasSubstr("method,muscle,frames,mean_ms,"));
  EXPECT_THAT(text, HasSubstr("\none,psoas,1,1.25,1.250,"));
  EXPECT_TRUE(text.ends_with(",\n"));
}

TEST(Comparison, the_page_stands_alone_and_takes_no_text_for_markup) {
  const TwoRuns two;
  const std::filesystem::path page = two.folder.path() / "comparison.html";
  const std::vector<ComparisonRow> rows = comparison_rows(two.runs, {0, 3});
  write_comparison_page(page, "leg <i>", two.runs, rows, {{3, "no picture"}});
  if (!Browser::is_there()) GTEST_SKIP() << "no Chromium";
  Browser& browser = Browser::fresh();
  browser.open(page);
  EXPECT_THAT(browser.requests, IsEmpty());
  EXPECT_EQ(browser.evaluate("document.querySelectorAll('#methods tr').length"), 3);
  EXPECT_EQ(browser.evaluate("document.querySelectorAll('svg').length"), 6) << "three charts of two muscles";
  EXPECT_EQ(browser.evaluate("document.querySelector('h1').textContent"), "leg <i>: methods side by side");
  EXPECT_EQ(browser.evaluate("document.querySelector('.trouble').textContent"), "frame 4: <script>");
  EXPECT_EQ(browser.evaluate("document.querySelectorAll('script, i, td b').length"), 0);
  EXPECT_EQ(browser.evaluate("document.querySelectorAll('img[alt=\"frame 3\"]').length"), 1);
}

}  // namespace gracilis
