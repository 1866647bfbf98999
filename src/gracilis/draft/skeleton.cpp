#include <gracilis/draft/skeleton.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/nearest_triangle.hpp>
#include <gracilis/io/suggestions.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace gracilis {
namespace {

std::string key_of(const KnownSegment& segment, BodySide side) {
  return segment.name + (segment.paired ? side_ending(side) : "");
}

/// Angle from `from` to `to` about the axis.
Real angle_about(const Vec3& axis, const Vec3& from, const Vec3& to) {
  const Vec3 u = from - from.dot(axis) * axis, v = to - to.dot(axis) * axis;
  return std::atan2(axis.dot(u.cross(v)), u.dot(v));
}

/// Builds a skeleton segment by segment.
struct Building {
  const FoundFolder& found;
  const JointOverrides& overrides;
  Skeleton& skeleton;
  std::set<std::string> used = {};  ///< overrides

  bool has_bones(const KnownSegment& segment, BodySide side) const {
    return std::any_of(found.bones.begin(), found.bones.end(), [&](const FoundBone& bone) {
      return bone.known && bone.known->segment == segment.name && (!segment.paired || bone.side == side);
    });
  }

  bool has_muscle(const std::vector<std::string>& names, BodySide side) const {
    return std::any_of(found.muscles.begin(), found.muscles.end(), [&](const FoundMuscle& muscle) {
      return muscle.known && (muscle.side == side || side == BodySide::none) &&
             std::find(names.begin(), names.end(), muscle.known->name) != names.end();
    });
  }

  bool has_bone(const std::vector<std::string>& names) const {
    return std::any_of(found.bones.begin(), found.bones.end(), [&](const FoundBone& bone) {
      return bone.known && std::any_of(names.begin(), names.end(), [&](const std::string& name) {
               return name.ends_with("*") ? bone.known->name.starts_with(name.substr(0, name.size() - 1))
                                          : bone.known->name == name;
             });
    });
  }

  /// The longest bone of a segment.
  const BoneAxis* axis_of(const std::string& segment, BodySide side) const {
    const BoneAxis* longest = nullptr;
    for (std::size_t b = 0; b < found.bones.size(); ++b) {
      const FoundBone& bone = found.bones[b];
      if (!bone.known || bone.known->segment != segment || bone.side != side || !skeleton.axes[b]) continue;
      if (!longest || skeleton.axes[b]->length() > longest->length()) longest = &*skeleton.axes[b];
    }
    return longest;
  }

  /// Whether the segment's own bones are those that the joint knows: not a patella instead of a tibia.
  bool concerns(const KnownJoint& joint, const KnownSegment& segment, BodySide side) const {
    if (joint.child == segment.name) return true;
    for (const std::vector<std::string>* names : {&joint.convex, &joint.concave})
      for (const std::size_t b : bones_named(found, *names, side))
        if (found.bones[b].known->segment == segment.name) return true;
    return false;
  }

  std::optional<JointFit> fit(const KnownJoint& joint, BodySide side) {
    const JointQuestion question{found, skeleton.axes, skeleton.frame, joint, side};
    const std::string name = joint.name + side_ending(side);
    if (const auto given = overrides.find(name); given != overrides.end()) {
      used.insert(name);
      return joint_at(given->second, question);
    }
    return fit_joint(question);
  }

  /// The palm looks forward, at -90 degrees, where the far end of the moving bone lies outwards of the resting one's.
  void find_pronation(const KnownJoint& known, BodySide side, DraftJoint& joint) const {
    const BoneAxis *resting = axis_of(known.parent, side), *moving = axis_of(known.child, side);
    if (!resting || !moving) return;
    Vec3 outwards = skeleton.frame.right();
    for (const DraftJoint& each : skeleton.joints)
      if (each.child == joint.parent) outwards = each.axes.front().direction;
    if (side == BodySide::left) outwards = -outwards;
    DraftAxis& axis = joint.axes.front();
    const Real turned = degrees(angle_about(axis.direction, outwards, moving->far - resting->far));
    axis.capture = radians(std::round(turned) - 90);
    joint.capture_guess = {
        joint.name + " capture pose",
        fmt::format("the forearm is turned by {:g} degrees from palm forward", std::round(turned) + 0.0), 0.6};
  }

  /// In the capture pose, by the long bones on both sides of a hinge.
  void find_capture(const KnownJoint& known, BodySide side, DraftJoint& joint) {
    joint.capture_guess = {joint.name + " capture pose", "taken as 0", 0.5};
    if (known.is_of_spine()) joint.capture_guess = {joint.name + " capture pose", "0: neutral as it stands", 0.7};
    if (known.kind == JointKind::pivot) find_pronation(known, side, joint);
    if (known.kind != JointKind::condyles && known.name != "elbow") return;
    const BoneAxis *above = axis_of(known.parent, side), *below = axis_of(known.child, side);
    if (!above || !below) return;
    DraftAxis& hinge = joint.axes.front();
    const Real angle = angle_about(hinge.direction, above->direction(), below->direction());
    // A straight limb's bones are not quite parallel.
    if (std::abs(angle) > radians(6)) hinge.capture = std::round(degrees(angle)) * radians(1);
    joint.capture_guess = {joint.name + " capture pose",
                           fmt::format("the long bones stand at {:g} degrees", std::round(degrees(angle)) + 0.0), 0.7};
  }

  void add_joint(const KnownJoint& known, BodySide side, const JointFit& fit, const std::string& parent,
                 const std::string& child) {
    DraftJoint joint{known.name + side_ending(side), parent, child, fit.center, {}, {}, {}};
    for (std::size_t i = 0; i < known.coordinates.size(); ++i) {
      const KnownCoordinate& coordinate = known.coordinates[i];
      joint.axes.push_back({with_side(coordinate.name, side), fit.axes[i], 0, coordinate.range_min,
                            coordinate.range_max, coordinate.shown});
    }
    joint.guess = {"joint " + joint.name, fit.how, fit.certainty};
    find_capture(known, side, joint);
    for (DraftAxis& axis : joint.axes) {
      axis.range_min = std::min(axis.range_min, axis.capture);
      axis.range_max = std::max(axis.range_max, axis.capture);
    }
    skeleton.joints.push_back(std::move(joint));
  }

  /// The body of a segment that has bones: its own where a joint moves it, else its nearest ancestor's.
  void place(const KnownSegment& segment, BodySide side) {
    const std::string key = key_of(segment, side), own = with_side(segment.body, side);
    std::vector<const KnownJoint*> on_the_way;
    const KnownSegment* at = &segment;
    while (!at->parent.empty()) {
      for (const KnownJoint& joint : dictionary().joints)
        if (joint.child == at->name) on_the_way.push_back(&joint);
      at = &dictionary().segment(at->parent);
      if (has_bones(*at, side)) break;
    }
    const bool is_root = at == &segment || !has_bones(*at, side);
    if (is_root && skeleton.root.empty()) {
      skeleton.root = skeleton.body_of_segment[key] = own;
      return;
    }
    const std::string above = is_root ? skeleton.root : skeleton.body_of_segment.at(key_of(*at, side));
    if (is_root) skeleton.guesses.push_back({own, "fixed to " + above + ": no bones between the two are here", 0.4});
    std::string why;
    Real certainty = 0.3;
    for (auto joint = on_the_way.rbegin(); joint != on_the_way.rend() && !is_root; ++joint) {
      if (!concerns(**joint, segment, side) || has_bone((*joint)->not_with)) continue;
      if (!(*joint)->only_with.empty() && !has_muscle((*joint)->only_with, side)) {
        if (!(*joint)->is_of_spine()) continue;
        why = ": none of the muscles that bend the spine there is here";
        certainty = 0.8;
        continue;
      }
      if (const std::optional<JointFit> found_fit = fit(**joint, side)) {
        add_joint(**joint, side, *found_fit, above, own);
        skeleton.body_of_segment[key] = own;
        return;
      }
      why = ": the surfaces do not show the joint '" + (*joint)->name + side_ending(side) + "'";
    }
    if (!why.empty()) skeleton.guesses.push_back({own, "fixed to " + above + why, certainty});
    skeleton.body_of_segment[key] = above;
  }

  void place_all() {
    for (const KnownSegment& segment : dictionary().segments) {
      const std::vector<BodySide> sides =
          segment.paired ? std::vector{BodySide::right, BodySide::left} : std::vector{BodySide::none};
      for (const BodySide side : sides)
        if (has_bones(segment, side)) place(segment, side);
    }
  }

  /// Says of a surface that holds several vertebrae that these do not move against each other.
  void tell_merged() {
    for (const FoundBone& bone : found.bones) {
      if (!bone.known || !bone.known->name.ends_with("spine")) continue;
      const auto bends = [&](const KnownJoint& joint) {
        return joint.is_of_spine() && joint.child == bone.known->segment && has_muscle(joint.only_with, bone.side);
      };
      if (std::any_of(dictionary().joints.begin(), dictionary().joints.end(), bends))
        skeleton.guesses.push_back(
            {bone.name, "one surface, so its vertebrae move as one; in a file each, as vertebra_l3.ply, they bend",
             0.5});
    }
  }

  /// Bones whose names are unknown go with the nearest known one.
  void give_bodies() {
    for (const FoundBone& bone : found.bones) {
      if (bone.known) {
        const KnownSegment& segment = dictionary().segment(bone.known->segment);
        skeleton.bodies.push_back(skeleton.body_of_segment.at(key_of(segment, bone.side)));
        continue;
      }
      const NearestTriangle tree(bone.mesh);
      const FoundBone* nearest = nullptr;
      Real least = std::numeric_limits<Real>::infinity();
      for (const FoundBone& other : found.bones) {
        if (!other.known) continue;
        for (Index v = 0; v < other.mesh.vertex_count(); v += 1 + other.mesh.vertex_count() / 500) {
          const Real distance = tree.query(other.mesh.vertices.col(v)).distance;
          if (distance < least) least = distance, nearest = &other;
        }
      }
      skeleton.bodies.push_back(
          skeleton.body_of_segment.at(key_of(dictionary().segment(nearest->known->segment), nearest->side)));
      skeleton.guesses.push_back(
          {bone.name, "its name is unknown: moves with " + nearest->name + ", the nearest bone", 0.3});
    }
  }
};

}  // namespace

std::string Skeleton::body_of(const std::string& segment, BodySide side) const {
  const Dictionary& known = dictionary();
  for (const KnownSegment* at = &known.segment(segment);; at = &known.segment(at->parent)) {
    if (const auto body = body_of_segment.find(key_of(*at, side)); body != body_of_segment.end()) return body->second;
    if (at->parent.empty()) break;
  }
  // Nothing above: the nearest below.
  std::vector<std::string> next = {segment};
  for (std::size_t i = 0; i < next.size(); ++i)
    for (const KnownSegment& each : known.segments) {
      if (each.parent != next[i]) continue;
      if (const auto body = body_of_segment.find(key_of(each, side)); body != body_of_segment.end())
        return body->second;
      next.push_back(each.name);
    }
  return root;
}

const DraftJoint* Skeleton::joint_of(const std::string& child) const {
  const auto joint = std::find_if(joints.begin(), joints.end(), [&](const DraftJoint& j) { return j.child == child; });
  return joint == joints.end() ? nullptr : &*joint;
}

int Skeleton::depth(const std::string& body) const {
  const DraftJoint* joint = joint_of(body);
  return joint ? 1 + depth(joint->parent) : 0;
}

Skeleton find_skeleton(const FoundFolder& found, const JointOverrides& overrides) {
  Skeleton skeleton;
  skeleton.axes = bone_axes(found);
  skeleton.frame = body_frame(found, skeleton.axes);
  Building building{found, overrides, skeleton};
  building.place_all();
  building.tell_merged();
  building.give_bodies();
  for (const auto& [name, points] : overrides) {
    if (building.used.contains(name)) continue;
    std::vector<std::string> known;
    for (const DraftJoint& joint : skeleton.joints) known.push_back(joint.name);
    throw ConfigurationError(
        {"--joint", "", "there is no joint '" + name + "' between these bones", suggestion(name, known)});
  }
  return skeleton;
}

}  // namespace gracilis
