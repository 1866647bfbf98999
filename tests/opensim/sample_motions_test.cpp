#include "opensim/model_texts.hpp"

#include <gracilis/opensim/kinematics/sample_motions.hpp>

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

TEST(SampleMotions, each_angle_goes_through_its_range_alone) {
  const Model model = ball();
  const auto motions = sample_motions(model, model.joints[0], 4);
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
  const auto motions = sample_motions(model, model.joints[0], 2);
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
  EXPECT_THROW(sample_motions(model, model.joints[0], 1000), ConfigurationError);
}

TEST(SampleMotions, a_joint_without_free_angles_has_none) {
  Model model = ball();
  for (Coordinate& coordinate : model.coordinates) coordinate.locked = true;
  EXPECT_TRUE(sample_motions(model, model.joints[0], 4).empty());
}

}  // namespace gracilis::opensim
