#include <gracilis/scene/validate.hpp>

#include <gracilis/scene/setting_table.hpp>
#include <gracilis/scene/validate_jumps.hpp>
#include <gracilis/scene/validate_lines.hpp>
#include <gracilis/scene/validate_muscle_bodies.hpp>
#include <gracilis/scene/validate_names.hpp>
#include <gracilis/scene/validate_sizes.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace gracilis {
namespace {

constexpr Real farthest = 1e7;  ///< m from the origin; beyond, numbers differ by nanometers, and volumes are noise

/// Collects problems of one scene.
struct Validation {
  const Scene& scene;
  std::vector<Problem> problems;

  void add(const std::string& where, const std::string& what, const std::string& remedy = "") {
    problems.push_back({"", where, what, remedy});
  }

  bool is_body(Index body) const { return body >= 0 && body < static_cast<Index>(scene.bodies.size()); }
  std::string body_name(Index body) const {
    return is_body(body) ? scene.bodies[body] : "number " + std::to_string(body);
  }

  void check_body(const std::string& where, Index body) {
    if (!is_body(body)) add(where, "refers to body number " + std::to_string(body) + ", which does not exist");
  }

  void check_surface(const std::string& where, const TriangleMesh& surface) {
    if (surface.face_count() == 0) add(where, "the surface has no triangles");
    for (Index i = 0; i < surface.vertex_count(); ++i) {
      const Vec3 place = surface.vertices.col(i);
      if (!place.allFinite())
        add(where, "vertex " + std::to_string(i) + " is not finite");
      else if (place.cwiseAbs().maxCoeff() > farthest)
        add(where, "vertex " + std::to_string(i) + " lies more than 10,000 km from the origin",
            "check its unit, or move the whole scene to the origin");
      else
        continue;
      break;
    }
    for (Index i = 0; i < surface.face_count(); ++i) {
      const auto corners = surface.faces.col(i);
      if (corners.minCoeff() >= 0 && corners.maxCoeff() < surface.vertex_count()) continue;
      add(where, "triangle " + std::to_string(i) + " refers to a vertex that does not exist");
      break;
    }
  }

  template <class Settings>
  void check_settings(const std::string& where, const Settings& settings) {
    for (const Setting<Settings>& setting : setting_table<Settings>()) {
      Settings copy = settings;
      const std::string message = assign(copy, setting, value_of(settings, setting));
      if (!message.empty()) add(where, "'" + std::string(setting.key) + "' " + message);
    }
  }

  void check_bones() {
    for (const Bone& bone : scene.bones) {
      const std::string where = "bone '" + bone.name + "'";
      check_body(where, bone.body);
      check_surface(where, bone.surface);
    }
  }

  void check_axis(const std::string& where, const JointAxis& axis, std::set<std::string>& coordinates) {
    if (axis.coordinate.empty()) add(where, "an axis has no coordinate");
    if (!coordinates.insert(axis.coordinate).second) add(where, "duplicate coordinate '" + axis.coordinate + "'");
    if (axis.axis.norm() < 1e-9) {
      add(where, "the axis of '" + axis.coordinate + "' has no length");
    } else if (!(std::abs(axis.axis.norm() - 1) < 1e-9)) {
      add(where, "the axis of '" + axis.coordinate + "' is not a unit vector");
    }
    if (!std::isfinite(axis.capture_value)) add(where, "the capture value of '" + axis.coordinate + "' is not finite");
    if (!(axis.range_min <= axis.range_max)) add(where, "the range of '" + axis.coordinate + "' ends before it begins");
  }

  void check_joints() {
    std::set<std::string> coordinates;
    std::set<Index> placed = {0};
    std::set<Index> children;
    for (const Joint& joint : scene.joints) {
      const std::string where = "joint '" + joint.name + "'";
      check_body(where, joint.parent_body);
      check_body(where, joint.child_body);
      if (!joint.frame.matrix().allFinite()) add(where, "its frame is not finite");
      if (joint.child_body == 0) {
        add(where, "moves the body '" + body_name(0) + "', which is fixed in the world");
      } else if (!children.insert(joint.child_body).second) {
        add(where, "the body '" + body_name(joint.child_body) + "' is moved by another joint already");
      } else if (!placed.count(joint.parent_body) && is_body(joint.parent_body)) {
        add(where, "its parent '" + body_name(joint.parent_body) + "' does not hang on a joint before it",
            "joints stand parents before children, and their chain starts at '" + body_name(0) + "'");
      }
      placed.insert(joint.child_body);
      for (const JointAxis& axis : joint.axes) check_axis(where, axis, coordinates);
    }
    for (Index body = 1; body < static_cast<Index>(scene.bodies.size()); ++body) {
      if (children.count(body) || muscle_body(scene, body)) continue;
      add("body '" + body_name(body) + "'", "no joint says how it moves against '" + body_name(0) + "'",
          "add a joint, or fix what belongs to it to '" + body_name(0) + "'");
    }
  }

  void check_attachment(const std::string& where, const Muscle& muscle, const Attachment& attachment,
                        std::map<Index, const Attachment*>& owners) {
    check_body(where, attachment.body);
    if (attachment.vertices.empty()) {
      add(where, "holds no vertex of the muscle", "give larger distances, or check units and names");
      return;
    }
    const auto& vertices = attachment.vertices;
    if (std::adjacent_find(vertices.begin(), vertices.end(), std::greater_equal<>()) != vertices.end()) {
      add(where, "its vertices do not ascend");
    }
    const auto [least, greatest] = std::minmax_element(vertices.begin(), vertices.end());
    if (*least < 0 || *greatest >= muscle.surface.vertex_count()) {
      add(where, "vertex " + std::to_string(*least < 0 ? *least : *greatest) + " does not exist",
          "the surface has vertices 0 to " + std::to_string(muscle.surface.vertex_count() - 1));
      return;
    }
    Index shared = 0;
    const Attachment* other = nullptr;
    for (Index vertex : vertices) {
      const auto [found, inserted] = owners.emplace(vertex, &attachment);
      if (inserted || found->second->body == attachment.body) continue;
      ++shared;
      other = found->second;
    }
    if (other) {
      add(where,
          std::to_string(shared) + " of its vertices are fixed to '" + body_name(other->body) +
              "' by the attachment '" + other->name + "' and cannot move with '" + body_name(attachment.body) + "' too",
          "give smaller distances");
    }
  }

  void check_corner(const SectionCorner& corner) {
    const Muscle& muscle = scene.muscles[static_cast<std::size_t>(corner.muscle)];
    const ActionLine& line = muscle.action_line;
    const Index sections = line.rays == 0 ? 0 : (muscle.surface.vertex_count() - 2) / line.rays;
    if (corner.section < sections && corner.ray < line.rays) return;
    add("muscle '" + muscle.name + "'", "a transversal names its section " + std::to_string(corner.section) + ", ray " +
                                            std::to_string(corner.ray) + ", which it does not have");
  }

  void check_transversals() {
    for (const Transversal& transversal : scene.transversals)
      for (const SectionCorner& corner : {transversal.moved, transversal.other})
        if (corner.muscle >= 0) check_corner(corner);
  }

  void check_muscles() {
    if (scene.muscles.empty()) add("", "the scene has no muscles", "add [[muscles]]");
    for (const Muscle& muscle : scene.muscles) {
      const std::string where = "muscle '" + muscle.name + "'";
      check_surface(where, muscle.surface);
      check_settings(where, muscle.fibers);
      check_settings(where, muscle.contraction);
      for (const Polylines* lines : {&muscle.given_fibers, &muscle.tracts, &muscle.given_surface_fibers})
        if (!lines->points.allFinite()) add(where, "a point of its fibers is not finite");
      for (const Aponeurosis& each : muscle.aponeuroses) check_surface(where + ", an aponeurosis", each.surface);
      std::map<Index, const Attachment*> owners;
      for (const Attachment& attachment : muscle.attachments) {
        check_attachment(where + ", attachment '" + attachment.name + "'", muscle, attachment, owners);
      }
      // A body that hangs on nothing is one, too; with one end only something was forgotten.
      if (muscle.attachments.empty()) continue;
      for (AttachmentEnd end : {AttachmentEnd::origin, AttachmentEnd::insertion}) {
        const bool found = std::any_of(muscle.attachments.begin(), muscle.attachments.end(),
                                       [&](const Attachment& a) { return a.end == end; });
        if (!found)
          add(where, end == AttachmentEnd::origin ? "it has no origin" : "it has no insertion", "add an attachment");
      }
    }
  }

  void check_activation() {
    std::set<std::string> driven, muscles, coordinates;
    for (const Muscle& muscle : scene.muscles) muscles.insert(muscle.name);
    for (const Joint& joint : scene.joints)
      for (const JointAxis& axis : joint.axes) coordinates.insert(axis.coordinate);
    const auto drive = [&](const std::string& where, const std::string& muscle) {
      if (muscles.count(muscle) && !driven.insert(muscle).second)
        add(where, "the muscle '" + muscle + "' is activated in another way already", "keep one of them");
    };
    for (const ActivationSignal& signal : scene.activation.signals) {
      const std::string where = "activation of '" + signal.muscle + "'";
      drive(where, signal.muscle);
      if (signal.times.empty() || signal.times.size() != signal.values.size()) {
        add(where, "it has " + std::to_string(signal.times.size()) + " times and " +
                       std::to_string(signal.values.size()) + " values");
      }
      if (std::adjacent_find(signal.times.begin(), signal.times.end(), std::greater_equal<>()) != signal.times.end())
        add(where, "its times do not increase");
      const auto finite = [](Real value) { return std::isfinite(value); };
      if (!std::all_of(signal.values.begin(), signal.values.end(), finite)) add(where, "a value is not finite");
    }
    for (const ActivationOfPose& function : scene.activation.functions) {
      drive("activation of '" + function.muscle + "'", function.muscle);
      if (!function.value) add("activation of '" + function.muscle + "'", "it has no function");
    }
    for (const JointControlUnit& unit : scene.activation.units) {
      const std::string where = "joint control unit '" + unit.name + "'";
      for (const std::string& muscle : unit.muscles) drive(where, muscle);
      for (const std::string& coordinate : unit.coordinates)
        if (!coordinates.count(coordinate)) add(where, "no joint has the coordinate '" + coordinate + "'");
      if (std::none_of(scene.joints.begin(), scene.joints.end(), [&](const Joint& j) { return j.name == unit.joint; }))
        add(where, "there is no joint '" + unit.joint + "'");
      const bool fits = unit.angles.rows() > 0 && unit.angles.rows() == unit.activations.rows() &&
                        unit.angles.cols() == static_cast<Index>(unit.coordinates.size()) &&
                        unit.activations.cols() == static_cast<Index>(unit.muscles.size());
      if (!fits) add(where, "its samples do not fit its coordinates and muscles");
      if (!unit.angles.allFinite() || !unit.activations.allFinite()) add(where, "a sample is not finite");
      if (!(unit.falloff >= 0)) add(where, "its falloff is negative");
      if (unit.neighbors < 1) add(where, "it asks no samples", "give 1 neighbor or more");
      if (!(unit.hit_distance >= 0)) add(where, "its distance of a hit is negative");
    }
  }

  void check_motion() {
    const Motion& motion = scene.motion;
    const std::string where = "motion '" + motion.name + "'";
    std::set<std::string> known, named;
    for (const Joint& joint : scene.joints)
      for (const JointAxis& axis : joint.axes) known.insert(axis.coordinate);
    for (const std::string& coordinate : motion.coordinates) {
      if (!known.count(coordinate)) add(where, "no joint has the coordinate '" + coordinate + "'");
      if (!named.insert(coordinate).second) add(where, "duplicate coordinate '" + coordinate + "'");
    }
    if (motion.values.rows() != static_cast<Index>(motion.times.size()) ||
        (motion.values.rows() > 0 && motion.values.cols() != static_cast<Index>(motion.coordinates.size()))) {
      add(where, "its table has " + std::to_string(motion.values.rows()) + " rows and " +
                     std::to_string(motion.values.cols()) + " columns, but there are " +
                     std::to_string(motion.times.size()) + " times and " + std::to_string(motion.coordinates.size()) +
                     " coordinates");
      return;
    }
    for (std::size_t row = 0; row < motion.times.size(); ++row) {
      if (!std::isfinite(motion.times[row]) || !motion.values.row(row).allFinite()) {
        add(where, "row " + std::to_string(row) + " is not finite");
        return;
      }
      if (row == 0 || motion.times[row] > motion.times[row - 1]) continue;
      add(where, "the time does not increase at row " + std::to_string(row));
      return;
    }
    for (Problem& problem : jump_problems(scene)) problems.push_back(std::move(problem));
  }
};

}  // namespace

std::vector<Problem> validate(const Scene& scene) {
  Validation validation{scene, {}};
  if (scene.bodies.empty()) validation.add("", "the scene has no bodies", "add [[bones]]");
  for (Problem& problem : name_problems(scene)) validation.problems.push_back(std::move(problem));
  validation.check_bones();
  validation.check_joints();
  validation.check_muscles();
  for (Problem& problem : line_problems(scene)) validation.problems.push_back(std::move(problem));
  for (Problem& problem : muscle_body_problems(scene)) validation.problems.push_back(std::move(problem));
  validation.check_transversals();
  validation.check_activation();
  validation.check_motion();
  validation.check_settings("distance_field", scene.distance_fields);
  validation.check_settings("sequence", scene.sequence);
  for (Problem& problem : size_problems(scene)) validation.problems.push_back(std::move(problem));
  return validation.problems;
}

}  // namespace gracilis
