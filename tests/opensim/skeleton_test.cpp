#include "opensim/model_texts.hpp"

#include <gracilis/opensim/kinematics/skeleton.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace gracilis::opensim {

static Eigen::VectorXd one(Real value) { return Eigen::VectorXd::Constant(1, value); }

TEST(Skeleton, the_torque_on_a_pendulum_is_that_of_its_equation_of_motion) {
  const Model model = model_from(pendulum());
  Skeleton skeleton(model);
  const BodyForces none = BodyForces::Zero(6, 2);
  const Real inertia = 0.1 + 2 * 0.25;  // about the hinge
  for (const Real swing : {0.0, 0.4, -1.2}) {
    skeleton.place(one(swing));
    const Real expected = inertia * 3 + 2 * 9.80665 * 0.5 * std::sin(swing);
    EXPECT_NEAR(skeleton.inverse_dynamics(one(5), one(3), none)[0], expected, 1e-12);
  }
}

TEST(Skeleton, a_force_on_the_tip_takes_its_share_of_the_torque) {
  const Model model = model_from(pendulum());
  Skeleton skeleton(model);
  skeleton.place(one(0.3));
  BodyForces push = BodyForces::Zero(6, 2);
  const RigidTransform& pose = skeleton.poses()[1];
  add_force(push, 1, pose, pose * Vec3(0, -1, 0), {7, 0, 0});
  EXPECT_NEAR(skeleton.generalized_forces(push)[0], 7 * std::cos(0.3), 1e-12);
  const Real without = skeleton.inverse_dynamics(one(0), one(0), BodyForces::Zero(6, 2))[0];
  EXPECT_NEAR(skeleton.inverse_dynamics(one(0), one(0), push)[0], without - 7 * std::cos(0.3), 1e-12);
}

TEST(Skeleton, a_slider_in_a_turned_frame_carries_the_part_of_the_weight_along_it) {
  const Model model = model_from(document(
      set("BodySet", body("sled")) +
      set("JointSet", joint("SliderJoint", "rail", "/ground", "sled", coordinate("way"), "", "1 2 3", "0 0 0.5"))));
  EXPECT_FALSE(model.coordinates[0].rotation);
  Skeleton skeleton(model);
  skeleton.place(one(2));
  EXPECT_TRUE(skeleton.poses()[1].translation().isApprox(Vec3(1 + 2 * std::cos(0.5), 2 + 2 * std::sin(0.5), 3)));
  EXPECT_NEAR(skeleton.inverse_dynamics(one(0), one(4), BodyForces::Zero(6, 2))[0], 2 * 4 + 2 * 9.80665 * std::sin(0.5),
              1e-12);
}

TEST(Skeleton, a_custom_joint_turns_about_moving_axes_and_shifts_along_fixed_ones) {
  const auto axis = [](const std::string& name, const std::string& coordinate_name, const std::string& direction) {
    return "<TransformAxis name=\"" + name + "\"><coordinates>" + coordinate_name + "</coordinates><axis>" + direction +
           "</axis><LinearFunction><coefficients>1 0</coefficients></LinearFunction></TransformAxis>";
  };
  const std::string transform = "<SpatialTransform>" + axis("rotation1", "a", "0 0 1") +
                                axis("rotation2", "b", "1 0 0") + axis("translation2", "c", "0 1 0") +
                                "</SpatialTransform>";
  const Model model =
      model_from(document(set("BodySet", body("rod")) +
                          set("JointSet", joint("CustomJoint", "j", "/ground", "rod",
                                                coordinate("a") + coordinate("b") + coordinate("c"), transform))));
  EXPECT_TRUE(model.coordinates[0].rotation);
  EXPECT_FALSE(model.coordinates[2].rotation);
  Skeleton skeleton(model);
  skeleton.place(Eigen::Vector3d(0.3, 0.5, 2));
  const Eigen::Matrix3d turned =
      (Eigen::AngleAxisd(0.3, Vec3::UnitZ()) * Eigen::AngleAxisd(0.5, Vec3::UnitX())).toRotationMatrix();
  EXPECT_TRUE(skeleton.poses()[1].linear().isApprox(turned, 1e-14));
  EXPECT_TRUE(skeleton.poses()[1].translation().isApprox(Vec3(0, 2, 0), 1e-14));
}

TEST(Skeleton, a_weld_holds_its_body_where_its_frames_say) {
  const Model model =
      model_from(document(set("BodySet", body("rod")) + set("JointSet", joint("WeldJoint", "fixed", "/ground", "rod",
                                                                              "", "", "1 0 0", "0.1 0.2 0.3"))));
  const Skeleton skeleton(model);
  EXPECT_TRUE(skeleton.poses()[1].isApprox(body_fixed_xyz({0.1, 0.2, 0.3}, {1, 0, 0}), 1e-14));
}

TEST(Skeleton, the_poses_of_a_free_body_follow_its_six_coordinates) {
  std::string coordinates;
  for (const char* name : {"rx", "ry", "rz", "tx", "ty", "tz"}) coordinates += coordinate(name);
  const Model model = model_from(document(set("BodySet", body("rod")) +
                                          set("JointSet", joint("FreeJoint", "free", "/ground", "rod", coordinates))));
  Skeleton skeleton(model);
  Eigen::VectorXd q(6);
  q << 0.1, -0.2, 0.3, 1, 2, 3;
  skeleton.place(q);
  EXPECT_TRUE(skeleton.poses()[1].isApprox(body_fixed_xyz({0.1, -0.2, 0.3}, {1, 2, 3}), 1e-14));
}

}  // namespace gracilis::opensim
