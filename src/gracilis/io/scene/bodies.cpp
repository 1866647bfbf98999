#include <gracilis/io/scene/bodies.hpp>

#include <gracilis/io/scene/files.hpp>

#include <algorithm>

namespace gracilis::sections {

BoneDescription read_bone(TomlReader table) {
  BoneDescription bone;
  bone.name = table.required_text("name");
  bone.body = table.text("body").value_or(bone.name);
  bone.surface = read_surface(table);
  bone.place = table.place();
  table.reject_unknown_keys();
  return bone;
}

static JointAxis read_axis(TomlReader table) {
  JointAxis axis;
  axis.coordinate = table.required_text("coordinate");
  const std::optional<Vec3> direction = table.required_vector("axis");
  if (direction && direction->norm() < 1e-9)
    table.add_problem("axis", "the axis has no length");
  else if (direction)
    axis.axis = direction->normalized();
  axis.translation = table.flag("translation").value_or(false);
  const Real unit = axis.translation ? 0.001 : radians(1);
  const std::string capture = axis.translation ? "capture_mm" : "capture_deg";
  const NumberRange values = axis.translation ? NumberRange{-1e5, 1e5, "mm"} : NumberRange{-360, 360, "degrees"};
  axis.capture_value = table.number(capture, values).value_or(0) * unit;
  const std::string range_key = axis.translation ? "range_mm" : "range_deg";
  if (const std::optional<Eigen::Vector2d> range = table.pair(range_key)) {
    axis.range_min = (*range)(0) * unit;
    axis.range_max = (*range)(1) * unit;
    if (axis.range_min > axis.range_max) table.add_problem(range_key, "the range ends before it begins");
  }
  table.reject_unknown_keys();
  return axis;
}

JointDescription read_joint(TomlReader table) {
  JointDescription result;
  Joint& joint = result.joint;
  joint.name = table.required_text("name");
  result.parent = table.required_text("parent");
  result.child = table.required_text("child");
  result.place = table.place();
  const Vec3 center = table.required_vector("center").value_or(Vec3::Zero()) * unit_of(table, "center_unit");
  const Vec3 angles = table.vector("orientation_xyz_rad").value_or(Vec3::Zero());
  joint.frame = Eigen::Translation3d(center) * Eigen::AngleAxisd(angles.x(), Vec3::UnitX()) *
                Eigen::AngleAxisd(angles.y(), Vec3::UnitY()) * Eigen::AngleAxisd(angles.z(), Vec3::UnitZ());
  for (TomlReader& axis : table.tables("axes")) joint.axes.push_back(read_axis(std::move(axis)));
  table.reject_unknown_keys();
  return result;
}

Index body_index(Scene& scene, const std::string& name) {
  std::vector<std::string>& bodies = scene.bodies;
  const auto found = std::find(bodies.begin(), bodies.end(), name);
  if (found != bodies.end()) return static_cast<Index>(found - bodies.begin());
  bodies.push_back(name);
  return static_cast<Index>(bodies.size()) - 1;
}

void place_bodies(SceneInProgress& progress) {
  Scene& scene = progress.loaded.scene;
  std::vector<const JointDescription*> waiting;
  for (const JointDescription& joint : progress.description.joints) waiting.push_back(&joint);
  const auto moved = [&](const std::string& body) {
    return std::any_of(waiting.begin(), waiting.end(), [&](const JointDescription* j) { return j->child == body; });
  };
  for (const JointDescription& joint : progress.description.joints)
    if (!moved(joint.parent)) body_index(scene, joint.parent);
  while (!waiting.empty()) {
    const auto next = std::find_if(waiting.begin(), waiting.end(),
                                   [&](const JointDescription* joint) { return !moved(joint->parent); });
    if (next == waiting.end()) {
      const JointDescription& first = *waiting.front();
      progress.add_problem(first.place, "joint '" + first.joint.name + "' moves its own parent '" + first.parent + "'",
                           "joints must not form a circle");
      return;
    }
    Joint joint = (*next)->joint;
    joint.parent_body = body_index(scene, (*next)->parent);
    joint.child_body = body_index(scene, (*next)->child);
    scene.joints.push_back(std::move(joint));
    waiting.erase(next);
  }
  for (const BoneDescription& bone : progress.description.bones) body_index(scene, bone.body);
}

void add_bone(SceneInProgress& progress, SurfaceLoader& surfaces, const BoneDescription& description) {
  Scene& scene = progress.loaded.scene;
  scene.bones.push_back({description.name, body_index(scene, description.body), {}});
  surfaces.take(description.surface, SurfaceRole::bone, scene.bones.back().surface);
}

}  // namespace gracilis::sections
