#include <gracilis/io/scene/bodies.hpp>

#include <gracilis/io/scene/files.hpp>

#include <algorithm>
#include <functional>
#include <optional>
#include <queue>
#include <unordered_map>

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

namespace {

/// The scene's bodies while they are told of one by one.
class BodyList {
 public:
  explicit BodyList(std::vector<std::string>& bodies) : bodies_(bodies) {
    for (std::size_t i = 0; i < bodies.size(); ++i) indices_.emplace(bodies[i], static_cast<Index>(i));
  }
  Index index(const std::string& name) {
    const auto [found, is_new] = indices_.emplace(name, static_cast<Index>(bodies_.size()));
    if (is_new) bodies_.push_back(name);
    return found->second;
  }

 private:
  std::vector<std::string>& bodies_;
  std::unordered_map<std::string, Index> indices_;
};

/// Joints that wait for those that move their parents; of those that wait no more the first in the file comes first.
class JointOrder {
 public:
  explicit JointOrder(const std::vector<JointDescription>& joints) : joints_(joints), done_(joints.size()) {
    for (std::size_t j = 0; j < joints.size(); ++j) {
      ++movers_[joints[j].child];
      on_parent_[joints[j].parent].push_back(j);
    }
    for (std::size_t j = 0; j < joints.size(); ++j)
      if (!is_moved(joints[j].parent)) ready_.push(j);
  }

  bool is_moved(const std::string& body) const { return movers_.contains(body); }

  /// Empty where all that are left wait for each other.
  std::optional<std::size_t> next() {
    if (ready_.empty()) return std::nullopt;
    const std::size_t joint = ready_.top();
    ready_.pop();
    done_[joint] = true;
    const std::string& child = joints_[joint].child;
    if (--movers_[child] > 0) return joint;
    movers_.erase(child);
    for (const std::size_t each : on_parent_[child]) ready_.push(each);
    return joint;
  }

  /// The first in the file that still waits; empty where none does.
  std::optional<std::size_t> first_waiting() const {
    const auto found = std::find(done_.begin(), done_.end(), false);
    if (found == done_.end()) return std::nullopt;
    return static_cast<std::size_t>(found - done_.begin());
  }

 private:
  const std::vector<JointDescription>& joints_;
  std::vector<bool> done_;
  std::unordered_map<std::string, int> movers_;  ///< waiting joints that move each body
  std::unordered_map<std::string, std::vector<std::size_t>> on_parent_;
  std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>> ready_;
};

}  // namespace

void place_bodies(SceneInProgress& progress) {
  Scene& scene = progress.loaded.scene;
  const std::vector<JointDescription>& joints = progress.description.joints;
  BodyList bodies(scene.bodies);
  JointOrder order(joints);
  for (const JointDescription& joint : joints)
    if (!order.is_moved(joint.parent)) bodies.index(joint.parent);
  while (const std::optional<std::size_t> next = order.next()) {
    const JointDescription& description = joints[*next];
    Joint joint = description.joint;
    joint.parent_body = bodies.index(description.parent);
    joint.child_body = bodies.index(description.child);
    scene.joints.push_back(std::move(joint));
  }
  if (const std::optional<std::size_t> waiting = order.first_waiting()) {
    const JointDescription& first = joints[*waiting];
    progress.add_problem(first.place, "joint '" + first.joint.name + "' moves its own parent '" + first.parent + "'",
                         "joints must not form a circle");
    return;
  }
  for (const BoneDescription& bone : progress.description.bones)
    progress.bone_bodies.push_back(bodies.index(bone.body));
}

void add_bone(SceneInProgress& progress, SurfaceLoader& surfaces, const BoneDescription& description) {
  Scene& scene = progress.loaded.scene;
  scene.bones.push_back({description.name, progress.bone_bodies[scene.bones.size()], {}});
  surfaces.take(description.surface, SurfaceRole::bone, scene.bones.back().surface);
}

}  // namespace gracilis::sections
