#include <gracilis/anatomy/joints/joint_twists.hpp>

#include <gracilis/anatomy/joints/axis_motion.hpp>
#include <gracilis/anatomy/joints/blended_bodies.hpp>
#include <gracilis/anatomy/joints/joint_pose.hpp>

namespace gracilis {

/// The joint that a body hangs on, or none.
static const Joint* joint_above(const Scene& scene, Index body) {
  for (const Joint& joint : scene.joints)
    if (joint.child_body == body) return &joint;
  return nullptr;
}

bool hangs_on(const Scene& scene, Index body, const Joint& joint) {
  for (const Joint* above = joint_above(scene, body); above; above = joint_above(scene, above->parent_body))
    if (above == &joint) return true;
  return false;
}

std::vector<std::vector<Twist>> joint_twists(const Scene& scene, std::span<const Real> coordinates) {
  const Pose pose = pose_at(scene, coordinates);
  std::vector<std::vector<Twist>> twists;
  std::size_t coordinate = 0;
  for (const Joint& joint : scene.joints) {
    RigidTransform frame = pose.bodies[static_cast<std::size_t>(joint.parent_body)] * joint.frame;
    for (const JointAxis& axis : joint.axes) {
      const Vec3 direction = frame.linear() * axis.axis;
      Twist twist;
      if (axis.translation)
        twist.velocity = direction;
      else
        twist = {frame.translation().cross(direction), direction};
      std::vector<Twist>& of_bodies = twists.emplace_back(scene.bodies.size());
      for (std::size_t body = 0; body < of_bodies.size(); ++body)
        if (hangs_on(scene, static_cast<Index>(body), joint)) of_bodies[body] = twist;
      add_twists(scene, of_bodies);
      frame = frame * axis_motion(axis, coordinates[coordinate++]);
    }
  }
  return twists;
}

}  // namespace gracilis
