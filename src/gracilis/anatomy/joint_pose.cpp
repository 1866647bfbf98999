#include <gracilis/anatomy/joint_pose.hpp>

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
static Eigen::Matrix3d rotation_since_capture(const Joint& joint, std::span<const Real> values) {
  Eigen::Matrix3d now = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d capture = Eigen::Matrix3d::Identity();
  bool moved = false;
  for (std::size_t i = 0; i < joint.axes.size(); ++i) {
    const JointAxis& axis = joint.axes[i];
    now = now * Eigen::AngleAxisd(values[i], axis.axis);
    capture = capture * Eigen::AngleAxisd(axis.capture_value, axis.axis);
    moved |= values[i] != axis.capture_value;
  }
  if (!moved) return Eigen::Matrix3d::Identity();
  return now * capture.transpose();
}

Pose pose_at(const Scene& scene, std::span<const Real> coordinates) {
  Pose pose;
  pose.coordinates.assign(coordinates.begin(), coordinates.end());
  pose.bodies.assign(scene.bodies.size(), RigidTransform::Identity());
  std::size_t first = 0;
  for (const Joint& joint : scene.joints) {
    assert(first + joint.axes.size() <= coordinates.size());
    const RigidTransform& parent = pose.bodies[joint.parent_body];
    const Eigen::Matrix3d rotation = rotation_since_capture(joint, coordinates.subspan(first, joint.axes.size()));
    first += joint.axes.size();
    RigidTransform& child = pose.bodies[joint.child_body];
    child = parent;
    if (rotation.isIdentity(0)) continue;
    // P R P⁻¹ turns about the joint's center by the rotation seen from the world.
    const Eigen::Matrix3d turned = joint.frame.linear() * rotation * joint.frame.linear().transpose();
    const Vec3 center = joint.frame.translation();
    RigidTransform about_center = RigidTransform::Identity();
    about_center.linear() = turned;
    about_center.translation() = center - turned * center;
    child = parent * about_center;
  }
  return pose;
}

}  // namespace gracilis
