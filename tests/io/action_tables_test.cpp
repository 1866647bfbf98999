#include <gracilis/io/tables/action_tables.hpp>

#include <scenes_for_tests.hpp>

#include <gtest/gtest.h>

#include "run_table_read_back.hpp"

namespace gracilis {
namespace {

/// Two fibers, of which the second is about to snap.
FrameRecord record_of(const Scene& scene, Real angle) {
  FrameRecord record;
  record.frame.pose = flexed(scene, angle);
  FiberActions& actions = record.actions.emplace_back();
  actions.arms.resize(2, 1);
  actions.arms << 0.02, 0.05;
  actions.mean_arms = actions.arms.row(0).transpose();
  actions.doubtful = {0, 1};
  actions.wrenches = Eigen::MatrixXd::Zero(6, 2);
  actions.wrenches.col(1) << 1, 2, 3, 0.1, 0.2, 0.3;
  actions.origin_directions = Points::Zero(3, 2);
  actions.origin_directions.row(2).setConstant(-1);
  actions.insertion_directions = -actions.origin_directions;
  return record;
}

TEST(ActionTables, tell_the_arms_of_each_coordinate_and_how_many_fibers_are_doubtful) {
  const Scene scene = tube_scene();
  const std::vector<RunTable> tables = action_tables(scene, record_of(scene, radians(30)), 1);
  ASSERT_EQ(tables.size(), 2u);
  EXPECT_EQ(tables[0].name, "moment_arms_flexion.sto");
  const Table arms = read_back(tables[0]);
  EXPECT_THAT(arms.columns, testing::ElementsAre("flexion", "tube", "tube_f000", "tube_f001", "tube_doubtful"));
  EXPECT_NEAR(value(arms, "flexion"), 30, 1e-9);
  EXPECT_EQ(value(arms, "tube"), 0.02);
  EXPECT_EQ(value(arms, "tube_f001"), 0.05);
  EXPECT_EQ(value(arms, "tube_doubtful"), 1);
}

TEST(ActionTables, tell_moments_about_the_origins_of_bodies) {
  const Scene scene = tube_scene();
  const FrameRecord record = record_of(scene, radians(30));
  const Table lines = read_back(action_tables(scene, record, 1).at(1));
  const Vec3 origin = record.frame.pose.bodies[1].translation(), force(1, 2, 3);
  ASSERT_GT(origin.norm(), 1e-3) << "the hinge is not at the ground's origin";
  const Vec3 moment = Vec3(0.1, 0.2, 0.3) + (Vec3::Zero() - origin).cross(force);
  for (int axis = 0; axis < 3; ++axis) {
    const std::string letter(1, "xyz"[axis]);
    EXPECT_EQ(value(lines, "tube_on_lower_force_" + letter), force[axis]);
    EXPECT_NEAR(value(lines, "tube_on_lower_moment_" + letter), moment[axis], 1e-9);
    EXPECT_EQ(value(lines, "tube_f000_origin_" + letter), axis == 2 ? -1 : 0);
    EXPECT_EQ(value(lines, "tube_f001_insertion_" + letter), axis == 2 ? 1 : 0);
  }
  EXPECT_EQ(value(lines, "tube_f000_doubtful"), 0);
  EXPECT_EQ(value(lines, "tube_f001_doubtful"), 1);
}

TEST(ActionTables, of_coordinates_with_one_name_for_their_files_are_two) {
  Scene scene = tube_scene();
  FrameRecord record = record_of(scene, radians(30));
  std::vector<JointAxis>& axes = scene.joints[0].axes;
  ASSERT_EQ(axes.size(), 1u);
  axes.push_back(axes[0]);
  axes[0].coordinate = "a b", axes[1].coordinate = "a_b";
  record.frame.pose.coordinates.push_back(0);
  record.actions[0].arms = Eigen::MatrixXd::Ones(2, 2);
  record.actions[0].mean_arms = Eigen::VectorXd::Ones(2);
  const std::vector<RunTable> tables = action_tables(scene, record, 1);
  EXPECT_EQ(tables.at(0).name, "moment_arms_a_b.sto");
  EXPECT_EQ(tables.at(1).name, "moment_arms_a_b_2.sto");
  EXPECT_EQ(moment_arm_file("a_b", {"a b", "a_b"}), tables.at(1).name) << "where readers look for it";
  for (const RunTable& table : tables) EXPECT_THAT(table_names(scene), testing::Contains(table.name));
}

TEST(ActionTables, there_are_none_where_nothing_is_known) {
  const Scene scene = tube_scene();
  FrameRecord record;
  record.frame.pose = flexed(scene, 0);
  EXPECT_TRUE(action_tables(scene, record, 1).empty());
  record.actions.resize(1);
  EXPECT_TRUE(action_tables(scene, record, 1).empty());
}

}  // namespace
}  // namespace gracilis
