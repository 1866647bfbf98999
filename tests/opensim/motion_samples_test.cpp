#include "opensim/model_texts.hpp"

#include <gracilis/geometry/halton.hpp>
#include <gracilis/geometry/latin_hypercube.hpp>
#include <gracilis/opensim/kinematics/sample_motions.hpp>
#include <gracilis/opensim/kinematics/spread_points.hpp>

#include <gtest/gtest.h>

#include <set>

namespace gracilis::opensim {

static Model ball() {
  const auto ranged = [](const std::string& name, const std::string& range) {
    return "<Coordinate name=\"" + name + "\"><default_value>0.1</default_value><range>" + range +
           "</range></Coordinate>";
  };
  return model_from(document(set("BodySet", body("rod")) +
                             set("JointSet", joint("UniversalJoint", "hip", "/ground", "rod",
                                                   ranged("flexion", "-1 1") + ranged("lift", "0 2")))));
}

/// Rows are the poses, without a way between them.
static SampleSettings poses_alone(int steps) {
  SampleSettings settings;
  settings.steps = steps;
  settings.speed = 0;
  return settings;
}

TEST(SampleMotions, each_angle_goes_through_its_range_alone) {
  const Model model = ball();
  const auto motions = sample_motions(model, model.joints[0], poses_alone(4));
  ASSERT_EQ(motions.size(), 3u);
  EXPECT_EQ(motions[0].name, "hip_flexion");
  ASSERT_EQ(motions[0].motion.values.rows(), 5);
  EXPECT_EQ(motions[0].motion.values(0, 0), -1);
  EXPECT_EQ(motions[0].motion.values(1, 0), -0.5);
  EXPECT_EQ(motions[0].motion.values(4, 0), 1);
  EXPECT_EQ(motions[0].motion.values(4, 1), 0.1);
}

TEST(SampleMotions, combinations_are_all_there_and_neighbors_differ_by_one_step) {
  const Model model = ball();
  const auto motions = sample_motions(model, model.joints[0], poses_alone(2));
  const Eigen::MatrixXd& values = motions[2].motion.values;
  ASSERT_EQ(values.rows(), 9);
  std::set<std::pair<Real, Real>> seen;
  for (Eigen::Index row = 0; row < 9; ++row) {
    seen.emplace(values(row, 0), values(row, 1));
    if (row == 0) continue;
    EXPECT_NEAR((values.row(row) - values.row(row - 1)).cwiseAbs().sum(), 1, 1e-12);
  }
  EXPECT_EQ(seen.size(), 9u);
}

TEST(SampleMotions, too_many_combinations_are_refused) {
  const Model model = ball();
  EXPECT_THROW(sample_motions(model, model.joints[0], poses_alone(1000)), ConfigurationError);
}

TEST(SampleMotions, angles_keep_their_range_and_speed_and_rest_in_each_pose) {
  const Model model = ball();
  SampleSettings settings;
  settings.steps = 2;
  settings.ranges["flexion"] = {-0.25, 0.75};
  settings.time_step = 0.005;
  settings.speed = 0.5;
  settings.combined = CombinedPoses::none;
  const auto motions = sample_motions(model, model.joints[0], settings);
  ASSERT_EQ(motions.size(), 2u);
  const CoordinateMotion& motion = motions[0].motion;
  const Eigen::VectorXd angle = motion.values.col(0);
  EXPECT_EQ(angle[0], -0.25);
  EXPECT_EQ(angle[angle.size() - 1], 0.75);
  EXPECT_EQ(angle[angle.size() / 2], 0.25);
  EXPECT_NEAR(motion.times[1], 0.005, 1e-15);
  const auto n = angle.size() - 1;
  const Eigen::VectorXd speed = (angle.tail(n) - angle.head(n)) / 0.005;
  EXPECT_LE(speed.maxCoeff(), 0.5 + 1e-9);
  EXPECT_GT(speed.maxCoeff(), 0.49);
  EXPECT_GE(speed.minCoeff(), 0);
  EXPECT_LT(speed[0], 1e-3);  // from rest
  EXPECT_LT(speed[n / 2], 1e-3);
  // Not faster than the curve's largest curvature, 5.77 times the turn over the square of the time.
  const Eigen::VectorXd acceleration = (speed.tail(n - 1) - speed.head(n - 1)) / 0.005;
  const Real leg = 0.005 * static_cast<Real>(n) / 2;
  EXPECT_LT(acceleration.cwiseAbs().maxCoeff(), 5.78 * 0.5 / (leg * leg));
}

TEST(SampleMotions, spread_poses_fill_the_range_in_an_order_of_neighbors) {
  const Model model = ball();
  for (const CombinedPoses way : {CombinedPoses::halton, CombinedPoses::latin}) {
    SampleSettings settings = poses_alone(1);
    settings.combined = way;
    settings.samples = 64;
    settings.ranges["lift"] = {0, 1};
    const Eigen::MatrixXd values = sample_motions(model, model.joints[0], settings)[2].motion.values;
    ASSERT_EQ(values.rows(), 64);
    Eigen::Matrix4i cells = Eigen::Matrix4i::Zero();
    Real way_along = 0;
    for (Eigen::Index row = 0; row < 64; ++row) {
      ++cells(static_cast<int>(2 * (values(row, 0) + 1)), static_cast<int>(4 * values(row, 1)));
      if (row > 0) way_along += (values.row(row) - values.row(row - 1)).norm();
    }
    EXPECT_GE(cells.minCoeff(), way == CombinedPoses::halton ? 2 : 1);
    EXPECT_LT(way_along, 64 * 0.4);  // 0.76 on average in no order
  }
}

TEST(SpreadPoints, halton_s_sequence_mirrors_digits_and_a_latin_hypercube_hits_every_stratum_once) {
  const Eigen::MatrixXd halton = halton_points(4, 2);
  EXPECT_TRUE(halton.col(0).isApprox(Eigen::Vector4d(0.5, 0.25, 0.75, 0.125)));
  EXPECT_TRUE(halton.col(1).isApprox(Eigen::Vector4d(1 / 3.0, 2 / 3.0, 1 / 9.0, 4 / 9.0)));
  const Eigen::MatrixXd latin = latin_hypercube(50, 3, 7);
  for (int column = 0; column < 3; ++column) {
    std::set<int> strata;
    for (int row = 0; row < 50; ++row) strata.insert(static_cast<int>(50 * latin(row, column)));
    EXPECT_EQ(strata.size(), 50u);
  }
  EXPECT_EQ(latin, latin_hypercube(50, 3, 7));
  EXPECT_NE(latin, latin_hypercube(50, 3, 8));
}

TEST(SampleMotions, a_joint_without_free_angles_has_none) {
  Model model = ball();
  for (Coordinate& coordinate : model.coordinates) coordinate.locked = true;
  EXPECT_TRUE(sample_motions(model, model.joints[0], poses_alone(4)).empty());
}

}  // namespace gracilis::opensim
