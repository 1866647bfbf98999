#include <gracilis/dynamics/solver/constraint_table.hpp>
#include <gracilis/methods/pass_tracing.hpp>

#include <scenes_for_tests.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

using namespace gracilis;

/// Everything that one frame, half a degree further, tells.
static std::vector<SolverPass> passes_of_a_frame(DeformationMethod& method, const Scene& scene, StepReport& report) {
  std::vector<SolverPass> passes;
  method.pass_tracing()->trace_passes([&](const SolverPass& pass) { passes.push_back(pass); });
  report = method.advance(flexed(scene, radians(0.5)), usual_time_step);
  method.pass_tracing()->trace_passes({});
  return passes;
}

TEST(SolverPasses, add_up_to_what_the_solver_corrects) {
  const Scene scene = tube_scene();
  const auto method = xpbd_on_tube(scene);
  StepReport report;
  const std::vector<SolverPass> passes = passes_of_a_frame(*method, scene, report);
  ASSERT_FALSE(passes.empty());
  Points sum = Points::Zero(3, scene.muscles[0].surface.vertex_count());
  for (const SolverPass& pass : passes) sum += pass.moved;
  EXPECT_GT(0.001 * metric(report.muscles[0].metrics, "largest_correction_mm"), 0);
  EXPECT_NEAR(sum.colwise().norm().maxCoeff(), 0.001 * metric(report.muscles[0].metrics, "largest_correction_mm"),
              1e-7);
}

TEST(SolverPasses, name_every_kind_and_every_iteration) {
  const Scene scene = tube_scene();
  const auto method = xpbd_on_tube(scene);
  StepReport report;
  std::set<std::string_view> kinds;
  std::set<int> iterations;
  for (const SolverPass& pass : passes_of_a_frame(*method, scene, report)) {
    EXPECT_EQ(pass.muscle, 0u);
    kinds.insert(pass.kind);
    iterations.insert(pass.iteration);
  }
  for (const ConstraintRow& row : constraint_table()) EXPECT_TRUE(kinds.contains(row.name)) << row.name;
  EXPECT_EQ(*iterations.begin(), 0);
  // The rounds that settle volume and contact come after the last iteration.
  EXPECT_EQ(*iterations.rbegin(), metric(report.muscles[0].metrics, "iterations"));
}

TEST(SolverPasses, are_watched_without_changing_anything) {
  const Scene scene = tube_scene();
  const auto watched = xpbd_on_tube(scene), alone = xpbd_on_tube(scene);
  int told = 0;
  watched->pass_tracing()->trace_passes([&](const SolverPass&) { ++told; });
  for (int degree = 1; degree <= 10; ++degree) {
    const Pose pose = flexed(scene, radians(degree));
    watched->advance(pose, usual_time_step);
    alone->advance(pose, usual_time_step);
    EXPECT_EQ(frame_of(*watched, pose, degree).muscles[0].points, frame_of(*alone, pose, degree).muscles[0].points);
  }
  EXPECT_GT(told, 100);
}

TEST(SolverPasses, are_told_to_nobody_who_has_stopped_watching) {
  const Scene scene = tube_scene();
  const auto method = xpbd_on_tube(scene);
  int told = 0;
  method->pass_tracing()->trace_passes([&](const SolverPass&) { ++told; });
  method->pass_tracing()->trace_passes({});
  method->advance(flexed(scene, radians(1)), usual_time_step);
  EXPECT_EQ(told, 0);
}
