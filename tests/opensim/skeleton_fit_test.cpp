#include "opensim/model_texts.hpp"

#include <gracilis/geometry/polylines.hpp>
#include <gracilis/opensim/import/muscle_volume.hpp>
#include <gracilis/opensim/import/skeleton_fit.hpp>
#include <gracilis/opensim/paths/muscle_path.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis::opensim {

/// Two rods of 0.5 m below each other, each on a pin about z; a muscle along the upper one and one over the lower
/// joint.
static Model two_rods() {
  return model_from(document(
      set("BodySet", body("upper") + body("lower")) +
      set("JointSet",
          joint("PinJoint", "hip", "/ground", "upper", coordinate("hip_angle")) +
              joint("PinJoint", "knee", "/bodyset/upper", "lower", coordinate("knee_angle"), "", "0 -0.5 0")) +
      set("ForceSet",
          muscle("along", point("/bodyset/upper", "0 -0.1 0") + point("/bodyset/upper", "0 -0.4 0"),
                 "<optimal_fiber_length>0.1</optimal_fiber_length>"
                 "<tendon_slack_length>0.2</tendon_slack_length>") +
              muscle("over", point("/bodyset/upper", "0.05 -0.4 0") + point("/bodyset/lower", "0.05 -0.1 0")))));
}

static std::vector<RigidTransform> poses_at(const Model& model, Real hip, Real knee) {
  Skeleton skeleton(model);
  skeleton.place(Eigen::Vector2d(hip, knee));
  return skeleton.poses();
}

TEST(SkeletonFit, without_targets_nothing_changes) {
  const Model model = two_rods(), fitted = fit_to_skeleton(model, {});
  for (const Real knee : {0.0, 0.7}) {
    const auto before = poses_at(model, 0.3, knee), after = poses_at(fitted, 0.3, knee);
    for (std::size_t b = 0; b < before.size(); ++b) EXPECT_TRUE(after[b].isApprox(before[b], 1e-12)) << b;
  }
  EXPECT_NEAR(fitted.muscles[0].optimal_fiber_length, 0.1, 1e-15);
}

TEST(SkeletonFit, a_body_is_scaled_by_its_lengths_ratio_and_turned_by_the_shortest_arc) {
  const Model model = two_rods();
  BodyFit fit;
  fit.body = "upper";
  fit.start = Vec3(0.1, 0, 0);
  fit.end = Vec3(0.7, -0.8, 0);  // 1 m, twice as long
  const Model fitted = fit_to_skeleton(model, {fit});
  const auto poses = poses_at(fitted, 0, 0);
  EXPECT_TRUE(poses[1].translation().isApprox(*fit.start, 1e-12));
  EXPECT_TRUE(poses[2].translation().isApprox(*fit.end, 1e-12));
  EXPECT_TRUE((poses[1] * fitted.muscles[0].path.points[1].location).isApprox(Vec3(0.58, -0.64, 0), 1e-12));
  // The lower rod keeps its length and goes on in the upper one's direction.
  EXPECT_TRUE((poses[2] * Vec3(0, -0.5, 0)).isApprox(Vec3(1.0, -1.2, 0), 1e-12));
  EXPECT_NEAR(fitted.muscles[0].optimal_fiber_length, 0.2, 1e-12);
  EXPECT_NEAR(fitted.muscles[0].tendon_slack_length, 0.4, 1e-12);
}

TEST(SkeletonFit, joints_turn_about_their_new_centers) {
  BodyFit fit;
  fit.body = "upper";
  fit.start = Vec3(0, 0, 0);
  fit.end = Vec3(0.6, -0.8, 0);
  const Model fitted = fit_to_skeleton(two_rods(), {fit});
  const auto rest = poses_at(fitted, 0, 0), bent = poses_at(fitted, 0, 0.5);
  EXPECT_TRUE(bent[2].translation().isApprox(rest[2].translation(), 1e-12));
  const Eigen::Matrix3d turn = bent[2].linear() * rest[2].linear().transpose();
  EXPECT_TRUE(turn.isApprox(Eigen::AngleAxisd(0.5, Vec3::UnitZ()).toRotationMatrix(), 1e-12));
}

TEST(SkeletonFit, a_joint_that_shifts_its_child_ends_the_body_where_the_child_is_now) {
  const std::string knee =
      "<SpatialTransform><TransformAxis name=\"rotation1\"><coordinates>bend</coordinates><axis>0 0 1</axis>"
      "<LinearFunction><coefficients>1 0</coefficients></LinearFunction></TransformAxis>"
      "<TransformAxis name=\"translation2\"><axis>0 1 0</axis><Constant><value>-0.4</value></Constant>"
      "</TransformAxis></SpatialTransform>";
  const Model model = model_from(
      document(set("BodySet", body("upper") + body("lower")) +
               set("JointSet", joint("PinJoint", "hip", "/ground", "upper", coordinate("hip_angle")) +
                                   joint("CustomJoint", "knee", "/bodyset/upper", "lower", coordinate("bend"), knee))));
  BodyFit fit;
  fit.body = "upper";
  fit.start = Vec3(0, 0, 0);
  fit.end = Vec3(0, -0.6, 0);
  const Model fitted = fit_to_skeleton(model, {fit});
  const auto poses = poses_at(fitted, 0, 0.5);
  EXPECT_TRUE(poses[2].translation().isApprox(Vec3(0, -0.6, 0), 1e-12));
  EXPECT_NEAR(value(fitted.joints[1].axes[4].function, {0}), -0.6, 1e-12);
}

/// A model with one muscle of tibialis anterior's lengths in the publication, along the upper rod.
static Model tibialis_anterior() {
  Model model = two_rods();
  Muscle& muscle = model.muscles[0];
  muscle.path.points[0].location = Vec3(0, -0.1, 0);
  muscle.path.points[1].location = Vec3(0, -0.1 - 0.303, 0);
  muscle.optimal_fiber_length = 0.098;
  muscle.pennation_angle_at_optimal = 0.087;
  muscle.tendon_slack_length = 0.223;
  return model;
}

static ActionLine imported_line(const Model& model, const VolumeSettings& settings = {}) {
  return muscle_volume(model, model.muscles[0], poses_at(model, 0, 0), Eigen::Vector2d::Zero(), settings).line;
}

TEST(SkeletonFit, a_half_tendon_is_as_long_as_published) {  // Laclé 2014, table 3.3
  const Model model = tibialis_anterior();
  VolumeSettings half;
  half.tendon = TendonPlace::half_at_insertion;
  EXPECT_NEAR(imported_line(model, half).tendon, 0.223 / 2, 1e-12);  // eqs. 3.9 and 3.10 change nothing without a fit
  BodyFit fit;
  fit.body = "upper";
  fit.start = Vec3::Zero();
  fit.end = Vec3(0, -0.5 * 0.292 / 0.303, 0);
  const ActionLine line = imported_line(fit_to_skeleton(model, {fit}), half);
  EXPECT_NEAR(polyline_length(line.points), 0.292, 1e-9);
  EXPECT_NEAR(line.tendon, 0.107, 5e-4);
  EXPECT_NEAR(line.tendon, 0.223 * 0.292 / 0.303 / 2, 1e-9);  // scaled once
}

TEST(SkeletonFit, a_tendon_leaves_a_fifth_of_the_line_to_the_belly) {
  Model model = tibialis_anterior();
  model.muscles[0].tendon_slack_length = 0.29;
  VolumeSettings settings;
  settings.tendon = TendonPlace::whole_at_insertion;
  EXPECT_NEAR(imported_line(model, settings).tendon, 0.8 * 0.303, 1e-12);
  settings.tendon = TendonPlace::both_ends;
  EXPECT_NEAR(imported_line(model, settings).origin_tendon, 0.4 * 0.303, 1e-12);
}

TEST(SkeletonFit, corrections_by_hand_come_last) {
  BodyFit fit;
  fit.body = "lower";
  fit.scale = Vec3(1, 3, 1);
  fit.turn = Vec3(0, 0, pi / 2);
  fit.shift = Vec3(0, 0, 0.01);
  const Model fitted = fit_to_skeleton(two_rods(), {fit});
  const auto poses = poses_at(fitted, 0, 0);
  EXPECT_TRUE(poses[2].translation().isApprox(Vec3(0, -0.5, 0.01), 1e-12));
  EXPECT_TRUE((poses[2] * fitted.muscles[1].path.points[1].location).isApprox(Vec3(0.3, -0.45, 0.01), 1e-12));
}

TEST(SkeletonFit, unknown_bodies_and_bodies_without_an_end_are_refused) {
  BodyFit fit;
  fit.body = "uper";
  EXPECT_THAT(message_of_input_error([&] { fit_to_skeleton(two_rods(), {fit}); }), testing::HasSubstr("'upper'"));
  fit.body = "lower";
  fit.end = Vec3::UnitX();
  EXPECT_THAT(message_of_input_error([&] { fit_to_skeleton(two_rods(), {fit}); }),
              testing::HasSubstr("carries no other body"));
}

TEST(SkeletonFit, a_file_names_places_in_millimetres_and_turns_in_degrees) {
  const TestFolder folder;
  const auto path = folder.write("fit.toml",
                                 "[bodies.upper]\nstart_mm = [100, 0, 0]\nend_mm = [700, -800, 0]\ntoward = \"lower\"\n"
                                 "[bodies.lower]\nturn_deg = [0, 0, 90]\nscale = [1, 2, 3]\n");
  const std::vector<BodyFit> fits = read_skeleton_fit(path);
  ASSERT_EQ(fits.size(), 2u);
  EXPECT_NEAR(fits[0].turn.z(), pi / 2, 1e-15);  // sorted by name
  EXPECT_EQ(fits[0].scale, Vec3(1, 2, 3));
  EXPECT_EQ(*fits[1].start, Vec3(0.1, 0, 0));
  const auto wrong = folder.write("wrong.toml", "[bodies.upper]\nstrat_mm = [1, 2, 3]\n");
  EXPECT_THAT(message_of_input_error([&] { read_skeleton_fit(wrong); }), testing::HasSubstr("start_mm"));
}

}  // namespace gracilis::opensim
