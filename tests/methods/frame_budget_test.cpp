#include <gracilis/methods/xpbd/frame_budget.hpp>

#include <scenes_for_tests.hpp>

#include <gtest/gtest.h>

namespace gracilis {

using xpbd::FrameBudget;

TEST(FrameBudget, without_a_rate_all_iterations_are_made) {
  FrameBudget budget;
  see_frame(budget, 1e6);
  EXPECT_EQ(budgeted_iterations(budget, 30), 30);
}

TEST(FrameBudget, finds_the_iterations_that_fit_and_keeps_them) {
  const auto time_of = [](int iterations) { return 4.0 + 0.6 * iterations; };  // ms
  FrameBudget budget{1000.0 / 60, 1};
  for (int frame = 0; frame < 60; ++frame) see_frame(budget, time_of(budgeted_iterations(budget, 70)));
  const int found = budgeted_iterations(budget, 70);
  EXPECT_LE(time_of(found), budget.budget);
  EXPECT_GE(time_of(found + 2), 0.8 * budget.budget);
}

TEST(FrameBudget, never_makes_more_iterations_than_asked_for_nor_fewer_than_the_least) {
  FrameBudget fast{1000, 1}, slow{1e-3, 1};
  for (int frame = 0; frame < 30; ++frame) see_frame(fast, 1), see_frame(slow, 100);
  EXPECT_EQ(budgeted_iterations(fast, 30), 30);
  EXPECT_EQ(budgeted_iterations(slow, 30), xpbd::least_iterations);
  EXPECT_EQ(budgeted_iterations(slow, 2), 2);
}

TEST(FrameBudget, a_method_says_what_it_gave_up_for_a_rate_that_no_machine_holds) {
  XpbdSettings settings;
  settings.target_fps = 1000;
  settings.iterations = 5000;
  const Scene scene = tube_scene(settings);
  const auto method = make_xpbd_method(scene, tube_fields());
  StepReport report;
  for (int degree = 1; degree <= 20; ++degree)
    report = method->advance(flexed(scene, radians(degree)), usual_time_step);
  EXPECT_EQ(metric(report.metrics, "target_fps"), 1000);
  EXPECT_EQ(metric(report.metrics, "asked_iterations"), 5000);
  EXPECT_LT(metric(report.metrics, "iterations"), 5000);
  EXPECT_EQ(metric(report.metrics, "asked_triangles"), scene.muscles[0].surface.face_count());
  EXPECT_LE(metric(report.metrics, "triangles"), metric(report.metrics, "asked_triangles"));
  EXPECT_GT(metric(report.metrics, "frame_milliseconds"), 0);
}

TEST(FrameBudget, limits_of_time_watch_the_clock_and_limits_of_iterations_do_not) {
  const auto watches = [](Real target_fps, Real stop_milliseconds) {
    XpbdSettings settings;
    settings.target_fps = target_fps;
    settings.stop_milliseconds = stop_milliseconds;
    const Scene scene = tube_scene(settings);
    return make_xpbd_method(scene, tube_fields())->depends_on_clock();
  };
  EXPECT_FALSE(watches(0, 0));
  EXPECT_TRUE(watches(30, 0));
  EXPECT_TRUE(watches(0, 5));
}

}  // namespace gracilis
