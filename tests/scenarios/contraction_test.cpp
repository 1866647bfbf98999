#include <gracilis/anatomy/joint_control.hpp>

#include "scenarios/active_runs.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace gracilis {
namespace {

/// The part of a line behind this share of its points.
Points part_from(const Points& line, Real share) {
  return line.rightCols(line.cols() - static_cast<Index>(share * static_cast<Real>(line.cols() - 1)));
}

/// By how much lines turn from there on, mean, rad.
Real mean_turn(const Polylines& lines, Real from) {
  Real sum = 0;
  for (Index i = 0; i < lines.count(); ++i) {
    const Points line = part_from(lines.line(i), from);
    for (Index k = 1; k + 1 < line.cols(); ++k) {
      const Vec3 before = line.col(k) - line.col(k - 1), after = line.col(k + 1) - line.col(k);
      sum += std::atan2(before.cross(after).norm(), before.dot(after)) / Real(lines.count());
    }
  }
  return sum;
}

/// By how much lines are longer from there on than the way between their ends, mean, m.
Real mean_excess(const Polylines& lines, Real from) {
  Real sum = 0;
  for (Index i = 0; i < lines.count(); ++i) {
    const Points line = part_from(lines.line(i), from);
    sum += (polyline_length(line) - (line.rightCols(1) - line.leftCols(1)).norm()) / Real(lines.count());
  }
  return sum;
}

Real rms_distance(const FiberRun& one, const FiberRun& other) {
  const Points difference = one.end[0].points - other.end[0].points;
  return std::sqrt(difference.colwise().squaredNorm().mean());
}

}  // namespace

TEST(ActiveMuscle, gluteus_medius_in_abduction_is_thicker_than_a_relaxed_one) {
  SKIP_WITHOUT_DATA();
  const FiberRun relaxed = active_run("gluteus_medius_r", {0, -35, 0}, 0),
                 active = active_run("gluteus_medius_r", {0, -35, 0}, 0.3);
  EXPECT_GE(active.frames.back()[0].cross_section, 1.05 * relaxed.frames.back()[0].cross_section);
  expect_volume(relaxed);
  expect_volume(active);
}

TEST(ActiveMuscle, iliacus_in_flexion_has_straighter_and_shorter_fibers) {
  SKIP_WITHOUT_DATA();
  const FiberRun relaxed = active_run("iliacus_r", {45, 0, 0}, 0), active = active_run("iliacus_r", {45, 0, 0}, 0.3);
  const MuscleFibers &slack = relaxed.frames.back()[0], &taut = active.frames.back()[0];
  EXPECT_LT(taut.mean_length, slack.mean_length - 0.0003);
  // The first third lies on the iliac fossa, from which it comes, and cannot become straight.
  EXPECT_LT(mean_turn(taut.lines, 1.0 / 3), 0.9 * mean_turn(slack.lines, 1.0 / 3));
  EXPECT_LT(mean_excess(taut.lines, 1.0 / 3), 0.9 * mean_excess(slack.lines, 1.0 / 3));
  expect_volume(relaxed);
  expect_volume(active);
}

TEST(ActiveMuscle, keeps_its_shape_whether_there_are_sixteen_fibers_or_a_hundred) {
  SKIP_WITHOUT_DATA();
  for (const char* muscle : {"psoas_major_r", "gluteus_medius_r"}) {
    const Vec3 to = Vec3(45, 0, 0);
    const FiberRun relaxed = active_run(muscle, to, 0), few = active_run(muscle, to, 0.3, 16),
                   many = active_run(muscle, to, 0.3);
    EXPECT_LT(rms_distance(few, many), 0.001) << muscle;
    EXPECT_LT(rms_distance(few, many), 0.25 * rms_distance(relaxed, many)) << muscle;
    expect_volume(few);
    expect_volume(many);
  }
}

TEST(JointControl, half_of_the_samples_of_a_gait_interpolate_the_others_within_a_tenth) {
  SKIP_WITHOUT_DATA();
  const Scene scene = cadaver_scene("gait");
  ASSERT_EQ(scene.activation.units.size(), 1u);
  const JointControlUnit& unit = scene.activation.units[0];
  ASSERT_EQ(unit.muscles.size(), 5u);
  ASSERT_GT(unit.angles.rows(), 100);
  const Eigen::VectorXd errors = leave_out_error(unit);
  for (Index i = 0; i < errors.size(); ++i) EXPECT_LE(errors[i], 0.1) << unit.muscles[static_cast<std::size_t>(i)];
}

}  // namespace gracilis
