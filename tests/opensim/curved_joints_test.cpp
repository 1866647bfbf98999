#include "opensim/model_texts.hpp"

#include <gracilis/opensim/kinematics/skeleton.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace gracilis::opensim {

static RigidTransform turn(Eigen::Index axis, Real angle) {
  return RigidTransform(Eigen::AngleAxisd(angle, Vec3::Unit(axis)));
}

/// A body that glides on an ellipsoid: turned about x, y, z in turn, its origin where the turned z axis points, times
/// the radii.
static RigidTransform on_ellipsoid(const Vec3& radii, const Vec3& q) {
  RigidTransform pose = turn(0, q[0]) * turn(1, q[1]) * turn(2, q[2]);
  pose.translation() = radii.cwiseProduct(Vec3(pose.linear().col(2)));
  return pose;
}

static std::string three() { return coordinate("a") + coordinate("b") + coordinate("c"); }

TEST(CurvedJoints, an_ellipsoid_joint_keeps_the_origin_on_the_ellipsoid) {
  const Model model = model_from(
      document(set("BodySet", body("rod")) +
               set("JointSet", joint("EllipsoidJoint", "glide", "/ground", "rod", three(),
                                     "<radii_x_y_z>0.1 0.2 0.3</radii_x_y_z>", "0.4 0.5 0.6", "0.3 0.2 0.1"))));
  EXPECT_TRUE(model.unsupported.empty());
  Skeleton skeleton(model);
  const RigidTransform frame = body_fixed_xyz({0.3, 0.2, 0.1}, {0.4, 0.5, 0.6});
  for (const Vec3& q : {Vec3(0, 0, 0), Vec3(0.5, -0.3, 1.2), Vec3(-2, 1, 0.4)}) {
    skeleton.place(q);
    const RigidTransform expected = frame * on_ellipsoid({0.1, 0.2, 0.3}, q);
    EXPECT_LT((skeleton.poses()[1].matrix() - expected.matrix()).norm(), 1e-14);
    const Vec3 place = frame.inverse() * Vec3(skeleton.poses()[1].translation());
    EXPECT_NEAR(place.cwiseQuotient(Vec3(0.1, 0.2, 0.3)).norm(), 1, 1e-14);
  }
  for (const Coordinate& coordinate : model.coordinates) EXPECT_TRUE(coordinate.rotation);
}

TEST(CurvedJoints, virtual_work_on_an_ellipsoid_is_the_slope_of_the_place) {
  const Model model = model_from(
      document(set("BodySet", body("rod")) + set("JointSet", joint("EllipsoidJoint", "glide", "/ground", "rod", three(),
                                                                   "<radii_x_y_z>0.1 0.2 0.3</radii_x_y_z>"))));
  Skeleton skeleton(model);
  const Vec3 q(0.5, -0.3, 1.2), force(1, -2, 3);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Real step = 1e-6;
    const Vec3 change = (on_ellipsoid({0.1, 0.2, 0.3}, q + step * Vec3::Unit(i)) * Vec3(0.1, 0, 0)) -
                        (on_ellipsoid({0.1, 0.2, 0.3}, q - step * Vec3::Unit(i)) * Vec3(0.1, 0, 0));
    skeleton.place(q);
    BodyForces forces = BodyForces::Zero(6, 2);
    add_force(forces, 1, skeleton.poses()[1], skeleton.poses()[1] * Vec3(0.1, 0, 0), force);
    EXPECT_NEAR(skeleton.generalized_forces(forces)[i], force.dot(change) / (2 * step), 1e-9);
  }
}

static std::string shoulder(const std::string& more) {
  return document(set("BodySet", body("scapula")) +
                  set("JointSet", joint("ScapulothoracicJoint", "glide", "/ground", "scapula",
                                        coordinate("abduction") + coordinate("elevation") + coordinate("upward") +
                                            coordinate("winging"),
                                        more, "0.1 0.2 0.3", "0.3 0.2 0.1")));
}

static const char* sizes =
    "<thoracic_ellipsoid_radii_x_y_z>0.07 0.15 0.08</thoracic_ellipsoid_radii_x_y_z>"
    "<scapula_winging_axis_origin>0.02 -0.03</scapula_winging_axis_origin>"
    "<scapula_winging_axis_direction>0.3</scapula_winging_axis_direction>";

TEST(CurvedJoints, a_scapula_glides_on_the_thorax_and_wings_about_an_axis_in_its_plane) {
  const Model model = model_from(shoulder(sizes));
  EXPECT_TRUE(model.unsupported.empty());
  ASSERT_EQ(model.coordinates.size(), 4u);
  Skeleton skeleton(model);
  const auto scapula = static_cast<std::size_t>(index_of(model.bodies, "scapula"));
  const RigidTransform frame = body_fixed_xyz({0.3, 0.2, 0.1}, {0.1, 0.2, 0.3});
  for (const Eigen::Vector4d& q :
       {Eigen::Vector4d(0, 0, 0, 0), Eigen::Vector4d(0.3, -0.4, 0.5, 0), Eigen::Vector4d(-0.6, 0.2, 0.4, 0.7)}) {
    skeleton.place(q);
    // The thorax's radii seen from axes turned by a right angle.
    const RigidTransform gliding =
        frame * turn(2, pi / 2) * on_ellipsoid({0.15, 0.07, 0.08}, q.head<3>()) * turn(2, -pi / 2);
    const Vec3 origin(0.02, -0.03, 0), axis(-std::sin(0.3), std::cos(0.3), 0);
    RigidTransform wing(Eigen::AngleAxisd(q[3], axis));
    wing.translation() = origin - wing.linear() * origin;
    EXPECT_LT((skeleton.poses()[scapula].matrix() - (gliding * wing).matrix()).norm(), 1e-14);
  }
}

TEST(CurvedJoints, ellipsoids_without_radii_and_joints_with_too_many_coordinates_are_refused) {
  EXPECT_THAT(complaint_about(shoulder("")), testing::HasSubstr("thoracic_ellipsoid_radii_x_y_z"));
  EXPECT_THAT(complaint_about(
                  document(set("BodySet", body("rod")) +
                           set("JointSet", joint("EllipsoidJoint", "glide", "/ground", "rod",
                                                 coordinate("a") + coordinate("b") + coordinate("c") + coordinate("d"),
                                                 "<radii_x_y_z>1 1 1</radii_x_y_z>")))),
              testing::HasSubstr("has 4 coordinates instead of 3"));
}

}  // namespace gracilis::opensim
