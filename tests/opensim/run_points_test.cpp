#include "opensim/model_texts.hpp"
#include "opensim/path_point_rules.hpp"

#include <gracilis/geometry/polylines.hpp>
#include <gracilis/opensim/export/fiber_points.hpp>
#include <gracilis/opensim/export/muscle_text.hpp>
#include <gracilis/opensim/paths/muscle_path.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis::opensim {

/// A pendulum swung through an angle, and fibers of five points from the ground to the rod that bow out while it turns.
struct SwungFibers {
  Model model = model_from(pendulum());
  std::vector<Real> angles;
  std::vector<Points> fibers;
  std::vector<std::vector<RigidTransform>> poses;

  SwungFibers() {
    Skeleton skeleton(model);
    for (int f = 0; f <= 28; ++f) {
      angles.push_back(-0.7 + 0.05 * f);
      skeleton.place(Eigen::VectorXd::Constant(1, angles.back()));
      poses.push_back(skeleton.poses());
      const Vec3 from(0.2, 0.1, 0), to = poses.back()[1] * Vec3(0.05, -0.3, 0);
      Points fiber(3, 5);
      for (int p = 0; p < 5; ++p)
        fiber.col(p) = from + p / 4.0 * (to - from) + 0.05 * angles.back() * std::sin(pi * p / 4) * Vec3::UnitZ();
      fibers.push_back(fiber);
    }
  }

  Real largest_error(const Path& path) const {
    Skeleton skeleton(model);
    Real largest = 0;
    for (std::size_t f = 0; f < fibers.size(); ++f) {
      const Eigen::VectorXd q = Eigen::VectorXd::Constant(1, angles[f]);
      skeleton.place(q);
      largest = std::max(largest, std::abs(measure_path(skeleton, path, q).length - polyline_length(fibers[f])));
    }
    return largest;
  }
};

TEST(RunPoints, ends_stay_with_the_bodies_that_they_move_with) {
  const SwungFibers run;
  const std::vector<FiberPoint> points = fit_points(run.fibers, run.poses, {});
  EXPECT_EQ(points.front().body, 0);
  EXPECT_EQ(points.back().body, 1);
  EXPECT_TRUE(points.back().location.isApprox(Vec3(0.05, -0.3, 0), 1e-12));
  EXPECT_LT(points.back().moves, 1e-12);
  EXPECT_GT(points[2].moves, 0.005);
}

TEST(RunPoints, points_that_move_with_the_only_coordinate_give_the_runs_lengths) {
  const SwungFibers run;
  const Path still = path_of(fit_points(run.fibers, run.poses, {}));
  const Path moving = path_of(fit_points(run.fibers, run.poses, {{0, run.angles}}));
  EXPECT_FALSE(still.points[2].moving);
  EXPECT_TRUE(moving.points[2].moving);
  EXPECT_FALSE(moving.points[4].moving);
  EXPECT_LT(run.largest_error(moving), 1e-4);
  EXPECT_GT(run.largest_error(still), 1e-3);
}

TEST(RunPoints, what_is_written_is_read_back_with_the_same_lengths_and_parameters) {
  const SwungFibers run;
  Muscle muscle;
  muscle.name = "m";
  muscle.type = "Millard2012EquilibriumMuscle";
  muscle.max_isometric_force = 321;
  muscle.path = path_of(fit_points(run.fibers, run.poses, {{0, run.angles}}));
  const Model read = model_from(pendulum(muscle_text(run.model, muscle)));
  ASSERT_EQ(read.muscles.size(), 1u);
  EXPECT_EQ(read.muscles[0].max_isometric_force, 321);
  EXPECT_EQ(read.muscles[0].type, muscle.type);
  EXPECT_TRUE(read.unsupported.empty());
  EXPECT_NEAR(run.largest_error(read.muscles[0].path), run.largest_error(muscle.path), 1e-9);
}

/// A point between two that stay: its x goes with the first coordinate, its y and z with the second, by more.
struct TwoCoordinates {
  FollowedCoordinate first{0, {}}, second{1, {}};
  std::vector<Points> fibers;
  std::vector<std::vector<RigidTransform>> poses =
      std::vector<std::vector<RigidTransform>>(40, {RigidTransform::Identity()});
  Real first_spread = 0;

  TwoCoordinates() {
    Eigen::VectorXd x(40);
    for (int f = 0; f < 40; ++f) {
      first.values.push_back(0.02 * f);
      second.values.push_back(0.5 * std::sin(1.7 * f));
      const Real turn = second.values.back();
      x[f] = 0.1 + 0.02 * first.values.back();
      Points fiber(3, 3);
      fiber.col(0) = Vec3::Zero();
      fiber.col(1) = Vec3(x[f], 0.03 * turn, 0.2 + 0.01 * turn * turn);
      fiber.col(2) = Vec3(0, 0, 0.4);
      fibers.push_back(fiber);
    }
    first_spread = std::sqrt((x.array() - x.mean()).square().mean());
  }
};

TEST(RunPoints, all_components_of_a_point_follow_the_coordinate_that_leaves_least) {
  const TwoCoordinates run;
  const FiberPoint point = fit_points(run.fibers, run.poses, {run.first, run.second})[1];
  EXPECT_EQ(point.coordinate, 1);
  EXPECT_TRUE(point.follows[0].knots.empty());
  EXPECT_FALSE(point.follows[1].knots.empty());
  EXPECT_FALSE(point.follows[2].knots.empty());
  EXPECT_NEAR(point.left, run.first_spread, 1e-6);
  EXPECT_EQ(fit_points(run.fibers, run.poses, {run.first})[1].coordinate, 0);
}

/// Two hinges, to whose coordinates points can be moved.
static std::string two_hinges() {
  return document(set("BodySet", body("upper") + body("lower")) +
                  set("JointSet", joint("PinJoint", "hip", "/ground", "upper", coordinate("swing")) +
                                      joint("PinJoint", "knee", "/bodyset/upper", "lower", coordinate("bend"))));
}

static std::string force_set_of(const std::string& muscles) {
  return "<OpenSimDocument Version=\"40000\">" + set("ForceSet", muscles) + "</OpenSimDocument>";
}

TEST(PathPointRules, points_that_we_write_break_none) {
  const TwoCoordinates run;
  const Model model = model_from(two_hinges());
  Muscle muscle;
  muscle.name = "m";
  muscle.path = path_of(fit_points(run.fibers, run.poses, {run.first, run.second}));
  ASSERT_TRUE(muscle.path.points[1].moving);
  EXPECT_THAT(broken_point_rules(force_set_of(muscle_text(model, muscle)), components_of(two_hinges())),
              testing::IsEmpty());
}

TEST(PathPointRules, a_point_with_two_coordinates_breaks_them) {
  const Model model = model_from(two_hinges());
  Muscle muscle;
  muscle.name = "m";
  muscle.path.points.resize(2);
  muscle.path.points[1].moving = true;
  muscle.path.points[1].moves_with = {0, 1, -1};
  muscle.path.points[1].moves_to = {simm_spline({0, 1}, {0, 1}), simm_spline({0, 1}, {0, 1}), constant(0.1)};
  const auto broken = [&] {
    return broken_point_rules(force_set_of(muscle_text(model, muscle)), components_of(two_hinges()));
  };
  EXPECT_THAT(broken(), testing::ElementsAre(testing::HasSubstr("moves with one coordinate")));
  muscle.path.points[1].moves_with[1] = 0;
  EXPECT_THAT(broken(), testing::IsEmpty());
}

TEST(RunPoints, a_path_that_stays_the_model_s_is_written_with_its_conditions_and_wraps) {
  const std::string points =
      point("/ground", "0.05 0.1 0") +
      "<ConditionalPathPoint name=\"c\"><socket_parent_frame>/bodyset/rod</socket_parent_frame><location>0.06 -0.1 "
      "0</location><socket_coordinate>/jointset/hinge/swing</socket_coordinate><range>-0.2 "
      "0.4</range></ConditionalPathPoint>" +
      point("/bodyset/rod", "0.03 -0.4 0");
  const std::string object =
      set("WrapObjectSet",
          "<WrapCylinder name=\"roll\"><quadrant>+x</quadrant><radius>0.04</radius><length>1</length>"
          "</WrapCylinder>");
  const std::string wraps =
      "<PathWrap name=\"w\"><wrap_object>roll</wrap_object><method>hybrid</method><range>-1 -1</range></PathWrap>";
  const Model model = model_from(pendulum(muscle("m", points, "", wraps), object));
  const Model again = model_from(pendulum(muscle_text(model, model.muscles[0]), object));
  ASSERT_EQ(again.muscles[0].path.wraps.size(), 1u);
  Skeleton one(model), other(again);
  for (const Real swing : {-0.6, 0.1, 0.7}) {
    const Eigen::VectorXd q = Eigen::VectorXd::Constant(1, swing);
    one.place(q);
    other.place(q);
    EXPECT_NEAR(measure_path(one, model.muscles[0].path, q).length,
                measure_path(other, again.muscles[0].path, q).length, 1e-12);
  }
}

}  // namespace gracilis::opensim
