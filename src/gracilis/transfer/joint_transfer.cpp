#include <gracilis/transfer/joint_transfer.hpp>

#include <gracilis/geometry/rotations.hpp>

#include <fmt/format.h>

#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace gracilis {
namespace {

Eigen::Matrix3d turn_of(const Joint& joint, const std::vector<Real>& values) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!joint.axes[i].translation) turn = turn * Eigen::AngleAxisd(values[i], joint.axes[i].axis);
  return turn;
}

Vec3 rotation_vector(const Eigen::Matrix3d& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

/// The joint that `draft` found between the bones of these two bodies.
const DraftJoint* shape_of(const Scene& scene, const Joint& joint, const Skeleton& skeleton) {
  const auto is_body = [&](Index body, const std::string& name) {
    for (std::size_t b = 0; b < skeleton.bodies.size(); ++b)
      if (scene.bones[b].body == body && skeleton.bodies[b] == name) return true;
    return false;
  };
  for (const DraftJoint& each : skeleton.joints)
    if (is_body(joint.parent_body, each.parent) && is_body(joint.child_body, each.child)) return &each;
  return nullptr;
}

bool has_fitted_axis(const std::string& name) {
  for (const KnownJoint& known : dictionary().joints)
    if (name.starts_with(known.name)) return known.kind != JointKind::ball;
  return false;
}

void take_capture(const SkeletonFit& fit, Joint& joint, const Eigen::Matrix3d& template_frame,
                  JointTransfer& transfer) {
  const Eigen::Matrix3d& parent = fit.bodies[static_cast<std::size_t>(joint.parent_body)].rotation;
  const Eigen::Matrix3d& child = fit.bodies[static_cast<std::size_t>(joint.child_body)].rotation;
  std::vector<Real> before;
  for (const JointAxis& axis : joint.axes) before.push_back(axis.capture_value);
  const std::vector<Real> now = nearest_values(
      joint, template_frame.transpose() * parent.transpose() * child * template_frame * turn_of(joint, before));
  for (std::size_t i = 0; i < now.size(); ++i) {
    JointAxis& axis = joint.axes[i];
    if (axis.translation || std::abs(now[i] - before[i]) < radians(0.005)) continue;
    axis.capture_value = now[i];
    axis.range_min = std::min(axis.range_min, now[i]);
    axis.range_max = std::max(axis.range_max, now[i]);
    transfer.captures.push_back(fmt::format("{}: the subject lies at {:.1f} degrees, the template at {:.1f}",
                                            axis.coordinate, degrees(now[i]), degrees(before[i])));
  }
}

}  // namespace

std::vector<Real> nearest_values(const Joint& joint, const Eigen::Matrix3d& rotation) {
  std::vector<Real> values;
  for (const JointAxis& axis : joint.axes) values.push_back(axis.capture_value);
  const auto n = static_cast<Eigen::Index>(values.size());
  for (int round = 0; round < 20; ++round) {
    const Vec3 lacking = rotation_vector(rotation * turn_of(joint, values).transpose());
    Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(3, n);
    Eigen::Matrix3d before = Eigen::Matrix3d::Identity();
    for (Eigen::Index i = 0; i < n; ++i) {
      const JointAxis& axis = joint.axes[static_cast<std::size_t>(i)];
      if (axis.translation) continue;
      slopes.col(i) = before * axis.axis;
      before = before * Eigen::AngleAxisd(values[static_cast<std::size_t>(i)], axis.axis);
    }
    const Eigen::VectorXd step = slopes.completeOrthogonalDecomposition().solve(lacking);
    for (Eigen::Index i = 0; i < n; ++i) values[static_cast<std::size_t>(i)] += step[i];
    if (step.norm() < 1e-12) break;
  }
  return values;
}

JointTransfer transfer_joint(const Scene& scene, const SkeletonFit& fit, const JointShapes& shapes,
                             const ThinPlateMap& warp, Joint& joint) {
  const Similarity& parent = fit.bodies[static_cast<std::size_t>(joint.parent_body)];
  const Similarity& child = fit.bodies[static_cast<std::size_t>(joint.child_body)];
  const Vec3 center = joint.frame.translation(), warped = warp.at(center);
  const Eigen::Matrix3d before = joint.frame.linear();
  joint.frame.linear() = parent.rotation * before;
  joint.frame.translation() = warped;
  JointTransfer transfer{{"joint " + joint.name, "carried with the bones around it", 0.7}, 0, {}};

  const DraftJoint* shape = shape_of(scene, joint, shapes.of_template);
  const std::vector<DraftJoint>& found = shapes.of_subject.joints;
  const auto same = std::find_if(found.begin(), found.end(),
                                 [&](const DraftJoint& each) { return shape && each.name == shape->name; });
  if (same != found.end()) {
    joint.frame.translation() = same->center + child.linear() * (center - shape->center);
    if (has_fitted_axis(shape->name))
      joint.frame.linear() = turn_from_to(parent.rotation * shape->axes.front().direction, same->axes.front().direction)
                                 .toRotationMatrix() *
                             joint.frame.linear();
    transfer.guess.how = fmt::format("as it lies in the template to {}; here {}", shape->guess.how, same->guess.how);
    transfer.guess.certainty = std::min(shape->guess.certainty, same->guess.certainty);
  }
  transfer.from_warp = (joint.frame.translation() - warped).norm();
  take_capture(fit, joint, before, transfer);
  return transfer;
}

}  // namespace gracilis
