#include "opensim/model_texts.hpp"

#include <gracilis/opensim/kinematics/coordinate_motion.hpp>
#include <gracilis/opensim/kinematics/loop_closer.hpp>
#include <gracilis/opensim/paths/path_tables.hpp>
#include <gracilis/opensim/static_optimization/joint_reactions.hpp>
#include <gracilis/opensim/static_optimization/static_optimization.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace gracilis::opensim {

/// A four-bar linkage: crank of 0.3 m on the ground, coupler of 1 m on the crank, rocker of 0.8 m on the ground 0.9 m
/// to the right; all hang down where their coordinates are zero.
static std::string four_bar(const std::string& closing, const std::string& forces = "") {
  return document(
      set("BodySet", body("crank") + body("coupler") + body("rocker")) +
      set("JointSet",
          joint("PinJoint", "left", "/ground", "crank", coordinate("turn", "1.5")) +
              joint("PinJoint", "middle", "/bodyset/crank", "coupler", coordinate("bend", "0.3"), "", "0 -0.3 0") +
              joint("PinJoint", "right", "/ground", "rocker", coordinate("rock"), "", "0.9 0 0")) +
      set("ConstraintSet", closing) + set("ForceSet", forces));
}

static const std::string pin =
    "<PointConstraint name=\"pin\"><socket_body_1>/bodyset/coupler</socket_body_1><socket_body_2>/bodyset/rocker"
    "</socket_body_2><location_body_1>0 -1 0</location_body_1><location_body_2>0 -0.8 0</location_body_2>"
    "</PointConstraint>";

/// Where the coupler meets the rocker: the intersection of two circles, the lower one.
static Vec3 meeting_point(Real turn) {
  const Vec3 crank_end = 0.3 * Vec3(std::sin(turn), -std::cos(turn), 0), hinge(0.9, 0, 0);
  const Vec3 between = hinge - crank_end;
  const Real d = between.norm(), along = (1 - 0.64 + d * d) / (2 * d), height = std::sqrt(1 - along * along);
  const Vec3 across = Vec3(between.y(), -between.x(), 0) / d;  // downwards
  return crank_end + along / d * between + height * across;
}

static Real rocker_angle(Real turn) {
  const Vec3 at = meeting_point(turn) - Vec3(0.9, 0, 0);
  return std::atan2(at.x(), -at.y());
}

TEST(ClosedLoops, a_four_bar_linkages_rocker_goes_where_circles_meet) {
  Model model = model_from(four_bar(pin));
  ASSERT_THAT(model.unsupported, testing::IsEmpty());
  ASSERT_EQ(model.loops.size(), 1u);
  EXPECT_LT(assemble_defaults(model, {true, false, false}).open, 1e-9);
  EXPECT_NEAR(model.coordinates[2].default_value, rocker_angle(1.5), 1e-8);
  const CoordinateMotion motion = sweep(model, 0, radians(-150), radians(200), radians(5));
  EXPECT_THAT(motion.notes, testing::IsEmpty());
  for (Eigen::Index row = 0; row < motion.values.rows(); ++row) {
    const Real turn = motion.values(row, 0);
    EXPECT_NEAR(turn, radians(-150 + 5 * static_cast<Real>(row)), 1e-12);
    EXPECT_NEAR(std::remainder(motion.values(row, 2) - rocker_angle(turn), 2 * pi), 0, 1e-7) << degrees(turn);
  }
}

/// A joint that moves the rocker, which hangs on the ground already, at the coupler's end.
static std::string second_joint(const std::string& type, const std::string& place) {
  return "<" + type +
         " name=\"pin\"><socket_parent_frame>from</socket_parent_frame><socket_child_frame>to"
         "</socket_child_frame><frames><PhysicalOffsetFrame name=\"from\"><socket_parent>/bodyset/coupler"
         "</socket_parent><translation>0 -1 0</translation></PhysicalOffsetFrame><PhysicalOffsetFrame name=\"to\">"
         "<socket_parent>/bodyset/rocker</socket_parent><translation>" +
         place + "</translation></PhysicalOffsetFrame></frames></" + type + ">";
}

TEST(ClosedLoops, a_joint_to_a_body_that_another_joint_holds_closes_the_linkage) {
  std::string text = four_bar("");
  text.insert(text.find("</objects></JointSet>"), second_joint("PinJoint", "0 -0.8 0"));
  Model model = model_from(text);
  EXPECT_THAT(names_of(model.bodies), testing::ElementsAre("ground", "crank", "coupler", "rocker", "rocker_copy"));
  EXPECT_EQ(model.bodies[4].mass, 0);
  EXPECT_THAT(model.unsupported, testing::Contains(testing::HasSubstr("moves 'rocker', which another joint holds")));
  // Near the way in which it closes: half a turn away a weld of directions has a second one.
  const Vec3 along = meeting_point(1.5) - 0.3 * Vec3(std::sin(1.5), -std::cos(1.5), 0);
  const Real coupler = std::atan2(along.x(), -along.y());
  model.coordinates[1].default_value = coupler - 1.5 + 0.1;
  model.coordinates[2].default_value = rocker_angle(1.5);
  model.coordinates[3].default_value = rocker_angle(1.5) - coupler;
  ASSERT_LT(assemble_defaults(model, {true, false, false, false}).open, 1e-9);
  const CoordinateMotion motion = sweep(model, 0, radians(85), radians(200), radians(5));
  for (Eigen::Index row = 0; row < motion.values.rows(); ++row) {
    const Real turn = motion.values(row, 0);
    EXPECT_NEAR(std::remainder(motion.values(row, 2) - rocker_angle(turn), 2 * pi), 0, 1e-7) << degrees(turn);
  }
}

TEST(ClosedLoops, a_second_joint_without_coordinates_holds_the_body_without_a_copy) {
  std::string text = four_bar("");
  text.insert(text.find("</objects></JointSet>"), second_joint("WeldJoint", "0 0.1 0"));
  Model model = model_from(text);
  EXPECT_EQ(model.bodies.size(), 4u);
  ASSERT_EQ(model.loops.size(), 1u);
  // Coupler and rocker are one body now, so that the linkage is a triangle: it stands still. Begun near it.
  model.coordinates[0].default_value = -0.6;
  model.coordinates[1].default_value = 2.4;
  model.coordinates[2].default_value = 1.8;
  ASSERT_LT(assemble_defaults(model).open, 1e-9);
  Skeleton skeleton(model);
  EXPECT_EQ(free_motions(skeleton, default_coordinates(model)).cols(), 0);
  const RigidTransform& coupler = skeleton.poses()[2];
  const RigidTransform& rocker = skeleton.poses()[3];
  EXPECT_LT((coupler * Vec3(0, -1, 0) - rocker * Vec3(0, 0.1, 0)).norm(), 1e-8);
  EXPECT_LT((coupler.linear() - rocker.linear()).norm(), 1e-8);
}

TEST(ClosedLoops, tables_that_give_the_crank_alone_move_the_rest) {
  Model model = model_from(four_bar(pin));
  assemble_defaults(model, {true, false, false});
  Table table;
  table.name = "crank.mot";
  table.columns = {"turn"};
  table.times = {0, 0.1, 0.2};
  table.values = Eigen::Vector3d(1.2, 1.3, 1.4);
  const CoordinateMotion motion = coordinate_motion(model, table);
  for (int row = 0; row < 3; ++row) EXPECT_NEAR(motion.values(row, 2), rocker_angle(1.2 + 0.1 * row), 1e-7);
}

TEST(ClosedLoops, given_coordinates_that_do_not_fit_give_way_and_are_named) {
  Model model = model_from(four_bar(pin));
  Table table;
  table.name = "all.mot";
  table.columns = {"turn", "bend", "rock"};
  table.times = {0, 0.1};
  Eigen::VectorXd fits = default_coordinates(model);
  LoopCloser(model).close(fits, {true, false, false});
  table.values = fits.transpose().replicate(2, 1);
  table.values(1, 2) += 0.02;
  const CoordinateMotion motion = coordinate_motion(model, table);
  EXPECT_THAT(motion.notes, testing::ElementsAre(testing::HasSubstr("had to give way")));
  Skeleton skeleton(model);
  for (int row = 0; row < 2; ++row) {
    skeleton.place(motion.values.row(row));
    EXPECT_LT(skeleton.loop_errors().norm(), 1e-7);
  }
  EXPECT_LT((motion.values.row(0).transpose() - fits).norm(), 1e-7);
  EXPECT_LT((motion.values.row(1) - table.values.row(1)).norm(), 0.02);  // no farther than back
}

/// A collar bone that turns about the breast, and a shoulder blade at its end that a rod holds to the trunk.
TEST(ClosedLoops, a_shoulder_blade_on_a_rod_keeps_its_distance) {
  Model model = model_from(
      document(set("BodySet", body("clavicle") + body("scapula")) +
               set("JointSet", joint("UniversalJoint", "sternum", "/ground", "clavicle",
                                     coordinate("protraction") + coordinate("elevation", "0.2")) +
                                   joint("PinJoint", "acromion", "/bodyset/clavicle", "scapula", coordinate("tilt"), "",
                                         "0 0 0.15")) +
               set("ConstraintSet",
                   "<ConstantDistanceConstraint "
                   "name=\"rod\"><socket_body_1>/ground</socket_body_1><socket_body_2>/bodyset/scapula"
                   "</socket_body_2><location_body_1>0.3 -0.1 0.1</location_body_1><location_body_2>-0.05 -0.1 0"
                   "</location_body_2><constant_distance>0.35</constant_distance></ConstantDistanceConstraint>")));
  ASSERT_LT(assemble_defaults(model).open, 1e-9);
  const CoordinateMotion motion = sweep(model, 0, radians(-8), radians(8), radians(2));
  Skeleton skeleton(model);
  for (Eigen::Index row = 0; row < motion.values.rows(); ++row) {
    skeleton.place(motion.values.row(row));
    EXPECT_NEAR((skeleton.poses()[2] * Vec3(-0.05, -0.1, 0) - Vec3(0.3, -0.1, 0.1)).norm(), 0.35, 1e-8);
    EXPECT_NEAR(motion.values(row, 0), radians(-8 + 2 * static_cast<Real>(row)), 1e-12);
  }
  EXPECT_GT((motion.values.row(0) - motion.values.row(8)).tail(2).norm(), 1e-3);
}

TEST(ClosedLoops, arms_are_those_of_the_moving_linkage) {
  const std::string muscle_text = muscle("m", point("/ground", "1.5 0 0") + point("/bodyset/rocker", "0 -0.4 0"));
  Model model = model_from(four_bar(pin, muscle_text));
  assemble_defaults(model, {true, false, false});
  const Real h = 1e-4;
  const CoordinateMotion motion = sweep(model, 0, 1.5 - h, 1.5 + h, h);
  const PathTables tables = path_tables(model, motion);
  const auto& lengths = tables.way_lengths.values;
  for (const auto& [coordinate, table] : tables.moment_arms)
    if (coordinate == "turn") {
      EXPECT_NEAR(table.values(1, 0), -(lengths(2, 0) - lengths(0, 0)) / (2 * h), 1e-6);
    }
  EXPECT_EQ(tables.moment_arms.size(), 3u);
}

/// A square of four rods that hang in a loop, held at its crank by a motor: the motor's moment by virtual work, and the
/// pin's force by the balance of the rocker.
TEST(ClosedLoops, a_motor_holds_a_linkage_and_its_joints_carry_it) {
  Model model = model_from(
      four_bar(pin,
               "<CoordinateActuator name=\"motor\"><coordinate>turn</coordinate><optimal_force>10</optimal_force>"
               "</CoordinateActuator>"));
  assemble_defaults(model, {true, false, false});
  CoordinateMotion motion;
  for (int i = 0; i < 8; ++i) motion.times.push_back(0.1 * i);
  motion.values = default_coordinates(model).transpose().replicate(8, 1);
  const StaticOptimizationResult result = static_optimization(model, motion, {}, {3}, {});
  ASSERT_TRUE(result.infeasible.empty());
  const auto height = [](Real turn) {  // of all three centers, each 0.5 m along its rod
    const Vec3 crank(std::sin(turn), -std::cos(turn), 0), end = 0.3 * crank, meet = meeting_point(turn);
    return 0.5 * crank.y() + (end + 0.5 * (meet - end)).y() + (0.5 * (meet - Vec3(0.9, 0, 0)) / 0.8).y();
  };
  const Real h = 1e-5, moment = 2 * 9.80665 * (height(1.5 + h) - height(1.5 - h)) / (2 * h);
  EXPECT_NEAR(result.forces.values(0, 0), moment, 1e-5);
  const Table loads = joint_reactions(model, motion, {}, {3}, result.forces, {});
  const auto at = [&](const std::string& column) { return loads.values(0, *column_of(loads, column)); };
  // Hinges without motors carry no moment about their axis, and the three that stand on the ground carry the weight.
  EXPECT_NEAR(at("middle_on_coupler_in_ground_mz"), 0, 1e-6);
  EXPECT_NEAR(at("right_on_rocker_in_ground_mz"), 0, 1e-6);
  EXPECT_NEAR(at("left_on_crank_in_ground_mz"), moment, 1e-5);
  EXPECT_NEAR(at("left_on_crank_in_ground_fy") + at("right_on_rocker_in_ground_fy"), 6 * 9.80665, 1e-6);
  EXPECT_NEAR(at("left_on_crank_in_ground_fx") + at("right_on_rocker_in_ground_fx"), 0, 1e-6);
}

TEST(ClosedLoops, frames_that_are_welded_coincide) {
  Model model = model_from(document(
      set("BodySet", body("rod")) + set("JointSet", joint("PinJoint", "hinge", "/ground", "rod", coordinate("swing"))) +
      set("ConstraintSet",
          "<WeldConstraint name=\"w\"><body_1>ground</body_1><body_2>rod</body_2><orientation_body_1>0 0 0.4"
          "</orientation_body_1></WeldConstraint>")));
  assemble_defaults(model);
  EXPECT_NEAR(model.coordinates[0].default_value, 0.4, 1e-8);
}

}  // namespace gracilis::opensim
