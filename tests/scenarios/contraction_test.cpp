#include <gracilis/anatomy/joints/joint_control.hpp>

#include "scenarios/active_runs.hpp"
#include "scenarios/placed_bones.hpp"

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

/// A line between the same ends, pulled tight around the bones.
Points pulled_tight(Points line, const PlacedBones& bones) {
  for (int i = 0; i < 2000; ++i)
    for (Index k = 1; k + 1 < line.cols(); ++k) line.col(k) = bones.outside((line.col(k - 1) + line.col(k + 1)) / 2);
  return line;
}

/// By how much lines are longer from there on than the shortest way around the bones, mean, m.
Real mean_excess(const Polylines& lines, Real from, const PlacedBones& bones) {
  Real sum = 0;
  for (Index i = 0; i < lines.count(); ++i) {
    const Points line = part_from(lines.line(i), from);
    sum += (polyline_length(line) - polyline_length(pulled_tight(line, bones))) / Real(lines.count());
  }
  return sum;
}

/// How far from the bones is, on average, what of a surface came within `reach` of them in the capture pose; m.
Real mean_distance(const Points& now, const PlacedBones& bones, const Points& captured, const PlacedBones& then,
                   Real reach) {
  Real sum = 0, count = 0;
  for (Index v = 0; v < now.cols(); ++v)
    if (then.distance(captured.col(v)) < reach) sum += bones.distance(now.col(v)), ++count;
  return sum / count;
}

Real rms_distance(const FiberRun& one, const FiberRun& other) {
  const Points difference = one.end[0].points - other.end[0].points;
  return std::sqrt(difference.colwise().squaredNorm().mean());
}

}  // namespace

static FiberRun medius_in_abduction(const std::string& skinning, Real activation) {
  Scene scene = active_scene("gluteus_medius_r", {0, -35, 0}, activation);
  scene.method.settings["skinning"] = skinning;
  FiberRun run = run_with_fibers(scene);
  expect_volume(run);
  return run;
}

TEST(ActiveMuscle, gluteus_medius_in_abduction_is_thicker_than_a_relaxed_one_that_bodies_carry) {
  SKIP_WITHOUT_DATA();
  const FiberRun relaxed = medius_in_abduction("bodies", 0), active = medius_in_abduction("bodies", 0.3);
  EXPECT_GE(active.frames.back()[0].cross_section, 1.05 * relaxed.frames.back()[0].cross_section);
}

/// Strings are taut whether a muscle is active or not.
TEST(ActiveMuscle, gluteus_medius_on_strings_is_thicker_in_abduction_and_active_no_thinner) {
  SKIP_WITHOUT_DATA();
  const FiberRun relaxed = medius_in_abduction("strings", 0), active = medius_in_abduction("strings", 0.3);
  EXPECT_GE(relaxed.frames.back()[0].cross_section, 1.05 * relaxed.frames.front()[0].cross_section);
  EXPECT_GE(active.frames.back()[0].cross_section, relaxed.frames.back()[0].cross_section);
}

TEST(ActiveMuscle, iliacus_in_flexion_has_straighter_and_shorter_fibers) {
  SKIP_WITHOUT_DATA();
  const FiberRun relaxed = active_run("iliacus_r", {45, 0, 0}, 0), active = active_run("iliacus_r", {45, 0, 0}, 0.3);
  const MuscleFibers &slack = relaxed.frames.back()[0], &taut = active.frames.back()[0];
  const Scene scene = active_scene("iliacus_r", {45, 0, 0}, 0);
  const PlacedBones bones = placed_bones(scene, pose_sequence(scene).back());
  EXPECT_LT(taut.mean_length, slack.mean_length - 0.0003);
  // The first third lies on the iliac fossa, from which it comes, and cannot become straight.
  EXPECT_LT(mean_turn(taut.lines, 1.0 / 3), 0.85 * mean_turn(slack.lines, 1.0 / 3));
  const Real excess = mean_excess(taut.lines, 1.0 / 3, bones);
  EXPECT_LT(excess, 0.8 * mean_excess(slack.lines, 1.0 / 3, bones));
  EXPECT_LT(excess, 0.02 * taut.mean_length) << "there is not much left to win";
  expect_volume(relaxed);
  expect_volume(active);
}

TEST(ActiveMuscle, iliacus_flexed_to_ninety_degrees_still_lies_on_the_bones_it_lay_on) {
  SKIP_WITHOUT_DATA();
  const Scene scene = active_scene("iliacus_r", {90, 0, 0}, 0.3);
  const std::vector<Pose> poses = pose_sequence(scene);
  const PlacedBones then = placed_bones(scene, capture_pose(scene.bodies.size())),
                    now = placed_bones(scene, poses.back());
  const Points &captured = scene.muscles[0].surface.vertices, flexed = run_with_fibers(scene).end[0].points;
  constexpr Real reach = 0.006;
  EXPECT_LT(mean_distance(flexed, now, captured, then, reach),
            mean_distance(captured, then, captured, then, reach) + 0.0005);
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

TEST(JointControl, half_of_the_samples_of_a_gait_interpolate_the_others_within_a_part_of_their_spread) {
  SKIP_WITHOUT_DATA();
  const Scene scene = cadaver_scene("gait");
  ASSERT_EQ(scene.activation.units.size(), 1u);
  const JointControlUnit& unit = scene.activation.units[0];
  ASSERT_EQ(unit.muscles.size(), 5u);
  ASSERT_GT(unit.angles.rows(), 100);
  const Eigen::VectorXd errors = leave_out_error(unit);
  for (Index i = 0; i < errors.size(); ++i) {
    const Eigen::ArrayXd known = unit.activations.col(i).array();
    const Real spread = std::sqrt((known - known.mean()).square().mean());
    const std::string& muscle = unit.muscles[static_cast<std::size_t>(i)];
    // Adductor brevis is hardly active in it.
    EXPECT_LE(errors[i], (muscle == "adductor_brevis_r" ? 0.6 : 0.2) * spread) << muscle << ", spread " << spread;
  }
}

}  // namespace gracilis
