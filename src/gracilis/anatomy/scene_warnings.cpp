#include <gracilis/anatomy/scene_warnings.hpp>

#include <gracilis/anatomy/attachments/attachments.hpp>
#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/geometry/measures.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace gracilis {

static std::string four_digits(Real value) {
  std::ostringstream text;
  text.precision(4);
  text << value;
  return text.str();
}

/// At most one digit after the point, and few digits of what no body does.
static std::string rounded(Real value) {
  if (std::abs(value) >= 1e6) return four_digits(value);
  std::string text = std::to_string(std::round(value * 10) / 10);
  text.resize(text.find('.') + 2);
  return text.ends_with(".0") ? text.substr(0, text.size() - 2) : text;
}

static void warn_about_range(const Motion& motion, const JointAxis& axis, std::vector<std::string>& warnings) {
  const auto column = std::find(motion.coordinates.begin(), motion.coordinates.end(), axis.coordinate);
  if (column == motion.coordinates.end() || motion.times.empty()) return;
  const auto values = motion.values.col(column - motion.coordinates.begin());
  // A millionth of a degree beyond the range is rounding.
  const Real tolerance = radians(1e-6);
  if (values.minCoeff() >= axis.range_min - tolerance && values.maxCoeff() <= axis.range_max + tolerance) return;
  warnings.push_back("the motion takes " + axis.coordinate + " from " + rounded(shown_value(axis, values.minCoeff())) +
                     " to " + rounded(shown_value(axis, values.maxCoeff())) + (axis.translation ? " mm" : " degrees") +
                     ", beyond the model's range of " + rounded(shown_value(axis, axis.range_min)) + " to " +
                     rounded(shown_value(axis, axis.range_max)) + "; it is followed as it is");
}

/// Where a joint's center is further from the bones of both bodies than these are large it is elsewhere than was meant.
static void warn_about_center(const Scene& scene, const Joint& joint, std::vector<std::string>& warnings) {
  Eigen::AlignedBox3d bones;
  bool of_parent = false, of_child = false;
  for (const Bone& bone : scene.bones) {
    if (bone.body != joint.parent_body && bone.body != joint.child_body) continue;
    bones.extend(bounding_box(bone.surface.vertices));
    of_parent = of_parent || bone.body == joint.parent_body;
    of_child = of_child || bone.body == joint.child_body;
  }
  const auto turns = [](const JointAxis& axis) { return !axis.translation; };
  if (!of_parent || !of_child || std::none_of(joint.axes.begin(), joint.axes.end(), turns)) return;
  const Real away = bones.exteriorDistance(Vec3(joint.frame.translation())), across = bones.diagonal().norm();
  if (!(away > across)) return;
  const auto body = [&](Index index) { return "'" + scene.bodies[static_cast<std::size_t>(index)] + "'"; };
  warnings.push_back("joint '" + joint.name + "': its center is " + four_digits(away) + " m from the bones of " +
                     body(joint.parent_body) + " and " + body(joint.child_body) + ", which are " + four_digits(across) +
                     " m across; 'center_unit' says in which unit it is given");
}

static void warn_about_size(const Muscle& muscle, const Attachment& attachment, std::vector<std::string>& warnings) {
  const std::string who = "attachment '" + attachment.name + "' of " + muscle.name;
  if (static_cast<Index>(attachment.vertices.size()) < handful) {
    warnings.push_back(who + " is held by a handful of vertices (" + std::to_string(attachment.vertices.size()) + ")");
    return;
  }
  const AttachmentArea area = attachment_area(muscle.surface, attachment.vertices);
  if (!area.sliver()) return;
  warnings.push_back(who + " is a sliver: " + rounded(area.length * 1e3) + " mm long and " + rounded(area.width * 1e3) +
                     " mm wide on average");
}

std::vector<std::string> warnings_about(const Scene& scene) {
  std::vector<std::string> warnings;
  for (const Joint& joint : scene.joints) {
    warn_about_center(scene, joint, warnings);
    for (const JointAxis& axis : joint.axes) warn_about_range(scene.motion, axis, warnings);
  }
  for (const Muscle& muscle : scene.muscles)
    for (const Attachment& attachment : muscle.attachments) warn_about_size(muscle, attachment, warnings);
  return warnings;
}

}  // namespace gracilis
