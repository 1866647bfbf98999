#include <gracilis/anatomy/joints/joint_pose.hpp>

#include <gracilis/anatomy/joints/axis_motion.hpp>
#include <gracilis/anatomy/joints/blended_bodies.hpp>

#include <cassert>

namespace gracilis {

std::vector<std::string> coordinate_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const Joint& joint : scene.joints)
    for (const JointAxis& axis : joint.axes) names.push_back(axis.coordinate);
  return names;
}

std::vector<Real> capture_coordinates(const Scene& scene) {
  std::vector<Real> values;
  for (const Joint& joint : scene.joints)
    for (const JointAxis& axis : joint.axes) values.push_back(axis.capture_value);
  return values;
}

/// X(q) X(q_capture)⁻¹. The identity without any rounding when q is q_capture.
static RigidTransform motion_since_capture(const Joint& joint, std::span<const Real> values) {
  RigidTransform now = RigidTransform::Identity(), capture = RigidTransform::Identity();
  bool moved = false;
  for (std::size_t i = 0; i < joint.axes.size(); ++i) {
    now = now * axis_motion(joint.axes[i], values[i]);
    capture = capture * axis_motion(joint.axes[i], joint.axes[i].capture_value);
    moved |= values[i] != joint.axes[i].capture_value;
  }
  if (!moved) return RigidTransform::Identity();
  return now * capture.inverse();
}

Pose pose_at(const Scene& scene, std::span<const Real> coordinates) {
  Pose pose;
  pose.coordinates.assign(coordinates.begin(), coordinates.end());
  pose.bodies.assign(scene.bodies.size(), RigidTransform::Identity());
  std::size_t first = 0;
  for (const Joint& joint : scene.joints) {
    assert(first + joint.axes.size() <= coordinates.size());
    const RigidTransform& parent = pose.bodies[joint.parent_body];
    const RigidTransform motion = motion_since_capture(joint, coordinates.subspan(first, joint.axes.size()));
    first += joint.axes.size();
    RigidTransform& child = pose.bodies[joint.child_body];
    child = parent;
    if (motion.matrix().isIdentity(0)) continue;
    // P X P⁻¹ turns about the joint's center by the rotation seen from the world, and shifts.
    const Eigen::Matrix3d turned = joint.frame.linear() * motion.linear() * joint.frame.linear().transpose();
    const Vec3 center = joint.frame.translation();
    RigidTransform about_center = RigidTransform::Identity();
    about_center.linear() = turned;
    about_center.translation() = center - turned * center + joint.frame.linear() * motion.translation();
    child = parent * about_center;
  }
  place_by_bodies(scene, pose);
  return pose;
}

}  // namespace gracilis
