#include <gracilis/strings/node_forces.hpp>

#include <gracilis/geometry/field_spline.hpp>
#include <gracilis/strings/cross_sections.hpp>
#include <gracilis/strings/relaxation.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gracilis::strings {

/// Middles of segments may come nearer to a bone than nodes by this, m: a chord cuts a corner.
static constexpr Real chord_allowance = 0.0005;
/// Gaps at rest that are larger than this are not asked for, m.
static constexpr Real farthest_gap = 0.06;
/// Stiffness of what goes with a body, over that of a segment.
static constexpr Real held_stiffness = 1e4;

static Real gap_at_rest(const MuscleStrings& muscle, std::size_t bone, Index node) {
  return std::min(muscle.bone_distances(static_cast<Index>(bone), node), farthest_gap);
}

Real kept_at_node(const MuscleStrings& muscle, std::size_t bone, Index node) {
  return std::min(gap_at_rest(muscle, bone, node), muscle.settings.bone_gap);
}

Real kept_at_middle(const MuscleStrings& muscle, std::size_t bone, Index node, Index other) {
  const Real gap = (gap_at_rest(muscle, bone, node) + gap_at_rest(muscle, bone, other)) / 2;
  return std::min(gap, muscle.settings.bone_gap) - chord_allowance;
}

/// An inner node while its forces are summed.
struct NodeForces::Node {
  Index string, i, p;     ///< p: its column
  Real length;            ///< m, of string that it stands for
  Vec3 place, direction;  ///< of the string, unit
  Vec3 across(const Vec3& v) const { return v - direction * direction.dot(v); }
  Eigen::Matrix3d projection() const { return Eigen::Matrix3d::Identity() - direction * direction.transpose(); }
};

NodeForces::NodeForces(const MuscleStrings& muscle, const BoneDistances& bones,
                       const std::vector<RigidTransform>& bodies)
    : muscle_(muscle), bones_(bones), bodies_(bodies) {
  for (const Index body : bones.bodies)
    to_bones_.emplace_back(bodies[static_cast<std::size_t>(body)].inverse().cast<float>());
  const auto blended = [&](Index p, const auto& of_body) {
    Vec3 sum = Vec3::Zero();
    for (Index b = 0; b < muscle.shares.rows(); ++b)
      if (muscle.shares(b, p) > 0) sum += muscle.shares(b, p) * of_body(bodies[static_cast<std::size_t>(b)]);
    return sum;
  };
  const Index count = static_cast<Index>(muscle.taut.cols());
  tied_to_.resize(3, count), support_places_.resize(3, count), support_normals_.setZero(3, count);
  for (Index p = 0; p < count; ++p) {
    tied_to_.col(p) = blended(p, [&](const RigidTransform& body) -> Vec3 { return body * Vec3(muscle.taut.col(p)); });
    const Vec3& normal = muscle.supports[static_cast<std::size_t>(p)].normal;
    if (normal.isZero(0)) continue;
    support_places_.col(p) =
        blended(p, [&](const RigidTransform& body) -> Vec3 { return body * Vec3(muscle.fibers.col(p)); });
    support_normals_.col(p) =
        blended(p, [&](const RigidTransform& body) -> Vec3 { return body.linear() * normal; }).normalized();
  }
  seen_nodes_.resize(bones.fields.size() * static_cast<std::size_t>(count));
  seen_middles_ = seen_nodes_;
  clear_ = Eigen::MatrixXd::Constant(static_cast<Index>(bones.fields.size()), muscle.strings, -1);
  travelled_.assign(static_cast<std::size_t>(muscle.strings), std::numeric_limits<Real>::infinity());
}

void NodeForces::begin_iteration(const Points& places) {
  if (muscle_.neighbors.empty() || muscle_.neighbors.front().empty()) return;
  before_ = places;
  section_turns_ = section_turns(muscle_, places);
}

void NodeForces::assemble(Index string, const Points& places, StringSystem& system) {
  const auto s = static_cast<std::size_t>(string);
  if (std::isinf(travelled_[s])) find_clear_bones(string, places);
  const Real segments = static_cast<Real>(muscle_.nodes - 1);
  system.tension = segments / muscle_.lengths[s];
  for (Index i = 1; i + 1 < muscle_.nodes; ++i) {
    const Index p = muscle_.node(string, i);
    const auto row = static_cast<std::size_t>(i);
    const Node node{
        string, i, p, muscle_.lengths[s] / segments, places.col(p), string_direction(muscle_, places, string, i)};
    system.stiffness[row] = 2 * system.tension * Eigen::Matrix3d::Identity();
    system.gradient[row] = system.tension * (2 * places.col(p) - places.col(p - 1) - places.col(p + 1));
    if (const Index body = body_holding(muscle_, string, i); body >= 0) {
      hold(node, body, system);
      continue;
    }
    tie(node, system);
    support(node, system);
    hold_among_neighbors(node, system);
    keep_from_bones(node, places, system);
  }
}

/// Most bones are far from a string: until it has travelled, none of its nodes or middles can be near these.
void NodeForces::find_clear_bones(Index string, const Points& places) {
  Real longest = 0;
  for (Index i = 0; i + 1 < muscle_.nodes; ++i) {
    const Index p = muscle_.node(string, i);
    longest = std::max(longest, (places.col(p + 1) - places.col(p)).norm());
  }
  for (std::size_t bone = 0; bone < bones_.fields.size(); ++bone) {
    Real nearest = std::numeric_limits<Real>::infinity();
    for (Index i = 0; i < muscle_.nodes; ++i) {
      const Eigen::Vector3f local = to_bones_[bone] * places.col(muscle_.node(string, i)).cast<float>();
      nearest = std::min(nearest, static_cast<Real>(sample_spline_bounded(bones_.fields[bone], local).distance));
    }
    clear_(static_cast<Index>(bone), string) = nearest - longest / 2 - muscle_.settings.bone_gap;
  }
  travelled_[static_cast<std::size_t>(string)] = 0;
}

/// A part that turns back goes with its bone.
void NodeForces::hold(const Node& node, Index body, StringSystem& system) const {
  const Vec3 place = bodies_[static_cast<std::size_t>(body)] * Vec3(muscle_.taut.col(node.p));
  const Real k = held_stiffness * system.tension;
  system.stiffness[static_cast<std::size_t>(node.i)] = k * Eigen::Matrix3d::Identity();
  system.gradient[static_cast<std::size_t>(node.i)] = k * (node.place - place);
}

/// Fascia: across the string, to where the bodies carry the node.
void NodeForces::tie(const Node& node, StringSystem& system) const {
  const Real length = muscle_.settings.tie_length;
  const Real k = muscle_.ties[node.p] * node.length / (length * length);
  if (!(k > 0)) return;
  system.stiffness[static_cast<std::size_t>(node.i)] += k * node.projection();
  system.gradient[static_cast<std::size_t>(node.i)] += k * node.across(node.place - tied_to_.col(node.p));
}

/// What the fiber rested on: bones that it may slide over, at their distance at rest, and for the rest a plane that
/// goes with the bodies.
void NodeForces::support(const Node& node, StringSystem& system) const {
  const NodeSupport& support = muscle_.supports[static_cast<std::size_t>(node.p)];
  if (support.normal.isZero(0)) return;
  const Real length = muscle_.settings.support_length;
  const Real k = node.length / (length * length);
  Real plane_share = 1;
  for (const Slide& slide : support.slides) {
    plane_share -= slide.share;
    const auto bone = static_cast<std::size_t>(slide.bone);
    const FieldSample seen = sample_spline(bones_.fields[bone].grid, to_bones_[bone] * node.place.cast<float>());
    const Real slope = static_cast<Real>(seen.gradient.norm()), distance = static_cast<Real>(seen.distance);
    if (slope < least_slope || distance >= slide.distance) continue;
    const Vec3 outward = (to_bones_[bone].linear().transpose() * seen.gradient).cast<Real>() / slope;
    system.add_spring(node.i, slide.share * k, node.across(outward), distance - slide.distance);
  }
  const Vec3 normal = node.across(support_normals_.col(node.p));
  const Real depth = normal.dot(node.place - support_places_.col(node.p));
  if (depth < 0 && plane_share > least_plane_share) system.add_spring(node.i, plane_share * k, normal, depth);
}

void NodeForces::hold_among_neighbors(const Node& node, StringSystem& system) const {
  const std::vector<Index>& neighbors = muscle_.neighbors[static_cast<std::size_t>(node.string)];
  if (neighbors.empty()) return;
  const Real length = muscle_.settings.neighbor_length;
  const Real k = node.length / (length * length);
  const Eigen::Matrix3d& turn = section_turns_[static_cast<std::size_t>(node.i)];
  Vec3 there = Vec3::Zero(), at_rest = Vec3::Zero();
  for (const Index neighbor : neighbors) {
    const Index q = muscle_.node(neighbor, node.i);
    there += before_.col(q), at_rest += muscle_.taut.col(q);
  }
  const Real count = static_cast<Real>(neighbors.size());
  const Vec3 place = there / count + turn * (muscle_.taut.col(node.p) - at_rest / count);
  system.stiffness[static_cast<std::size_t>(node.i)] += k * node.projection();
  system.gradient[static_cast<std::size_t>(node.i)] += k * node.across(node.place - place);
}

/// Whether a point is nearer to a bone than `kept`; then by how much (negative), and which way leads out.
bool NodeForces::bone_force(std::size_t bone, const Vec3& place, Real kept, Seen& seen, Real& depth,
                            Vec3& normal) const {
  const Eigen::Vector3f local = to_bones_[bone] * place.cast<float>();
  const auto far = static_cast<float>(kept);
  if (seen.distance > far && (local - seen.place).norm() < seen.distance - far) return false;
  const FieldSample here = sample_spline_bounded(bones_.fields[bone], local);
  seen = {local, here.distance};
  const float slope = here.gradient.norm();
  if (here.distance >= far || static_cast<Real>(slope) < least_slope) return false;
  depth = static_cast<Real>(here.distance) - kept;
  normal = (to_bones_[bone].linear().transpose() * here.gradient / slope).cast<Real>();
  return true;
}

/// Nodes and middles of segments keep to bones the gap at rest, or less.
void NodeForces::keep_from_bones(const Node& node, const Points& places, StringSystem& system) {
  const StringSettings& settings = muscle_.settings;
  const Real k = settings.bone_stiffness * system.tension;
  const std::size_t count = static_cast<std::size_t>(places.cols());
  for (std::size_t bone = 0; bone < bones_.fields.size(); ++bone) {
    if (clear_(static_cast<Index>(bone), node.string) > travelled_[static_cast<std::size_t>(node.string)]) continue;
    Real depth = 0;
    Vec3 normal;
    const std::size_t here = bone * count + static_cast<std::size_t>(node.p);
    if (bone_force(bone, node.place, kept_at_node(muscle_, bone, node.p), seen_nodes_[here], depth, normal))
      system.add_spring(node.i, k, normal, depth);
    // The middle of a segment is shared by its two nodes.
    const auto middle = [&](Index other, Seen& seen) {
      const Vec3 place = (node.place + places.col(other)) / 2;
      const Real kept = kept_at_middle(muscle_, bone, node.p, other);
      if (bone_force(bone, place, kept, seen, depth, normal)) system.add_spring(node.i, k / 2, normal, depth);
    };
    if (node.i + 2 < muscle_.nodes) middle(node.p + 1, seen_middles_[here]);
    if (node.i > 1) middle(node.p - 1, seen_middles_[here - 1]);
  }
}

}  // namespace gracilis::strings
